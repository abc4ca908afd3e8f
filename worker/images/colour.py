"""Light and its encodings: the sRGB curve, luminance, premultiplied alpha, primaries.

Everything here takes and gives float32 arrays of any shape, linear Rec.709 unless said otherwise.
"""

from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

Float = TypeVar("Float", np.float32, np.float64)

# IEC 61966-2-1:1999, 5.2: straight below the break, a power above it.
_BREAK_LINEAR = 0.0031308
_BREAK_ENCODED = 0.04045
_SLOPE = 12.92
_SCALE = 1.055
_OFFSET = 0.055
_POWER = 2.4

# Rec. ITU-R BT.709-6, item 3.2: the luminance of the primaries.
LUMINANCE_WEIGHTS = (0.2126, 0.7152, 0.0722)

# CIE x, y of red, green, blue and white (D65) of Rec. ITU-R BT.709-6, item 1.3 and 1.4.
REC709_CHROMATICITIES = (0.64, 0.33, 0.30, 0.60, 0.15, 0.06, 0.3127, 0.3290)


def srgb_from_linear(linear: NDArray[Float]) -> NDArray[Float]:
    """Encode linear light with the sRGB curve (IEC 61966-2-1), in float64, rounded once.

    Values above 1 go on along the power; negative values mirror the curve about the origin.
    """
    size = np.abs(linear, dtype=np.float64)
    power = _SCALE * np.power(size, 1 / _POWER) - _OFFSET
    encoded = np.where(size <= _BREAK_LINEAR, _SLOPE * size, power)
    return np.copysign(encoded, linear).astype(linear.dtype)


def linear_from_srgb(encoded: NDArray[Float]) -> NDArray[Float]:
    """Decode the sRGB curve (IEC 61966-2-1) to linear light, in float64, rounded once.

    Values above 1 go on along the power; negative values mirror the curve about the origin.
    """
    size = np.abs(encoded, dtype=np.float64)
    power = np.power((size + _OFFSET) / _SCALE, _POWER)
    linear = np.where(size <= _BREAK_ENCODED, size / _SLOPE, power)
    return np.copysign(linear, encoded).astype(encoded.dtype)


def luminance(colour: NDArray[np.float32]) -> NDArray[np.float32]:
    """Weigh red, green and blue, shape (..., 3 or more), to luminance, shape (...)."""
    red, green, blue = (np.float32(weight) for weight in LUMINANCE_WEIGHTS)
    weighed = red * colour[..., 0] + green * colour[..., 1] + blue * colour[..., 2]
    return np.asarray(weighed, np.float32)


def premultiply(straight: NDArray[np.float32]) -> NDArray[np.float32]:
    """Multiply all channels but the last, shape (..., C), by the last, which is alpha."""
    premultiplied = straight.copy()
    alpha = straight[..., -1]
    # Channel by channel: numpy's inner loop then runs over texels, not over three numbers.
    for channel in range(straight.shape[-1] - 1):
        premultiplied[..., channel] *= alpha
    return premultiplied


def unpremultiply(premultiplied: NDArray[np.float32]) -> NDArray[np.float32]:
    """Divide all channels but the last, shape (..., C), by the last; alpha 0 gives colour 0."""
    straight = np.zeros_like(premultiplied)
    alpha = premultiplied[..., -1]
    covered = alpha > 0
    for channel in range(premultiplied.shape[-1] - 1):
        np.divide(premultiplied[..., channel], alpha, out=straight[..., channel], where=covered)
    straight[..., -1] = alpha
    return straight


def rec709_from(chromaticities: tuple[float, ...]) -> NDArray[np.float64]:
    """Give the 3 x 3 matrix that takes linear RGB of other primaries to Rec.709.

    Both whites stay what they are: XYZ is kept, nothing is adapted (Lindbloom, "RGB/XYZ
    Matrices"; the same as OpenEXR's RGBtoXYZ and XYZtoRGB).

    Args:
        chromaticities: CIE x, y of red, green, blue and white: eight numbers.

    Raises:
        ValueError: The primaries do not span a colour space.
    """
    try:
        matrix = np.linalg.solve(_xyz_from(REC709_CHROMATICITIES), _xyz_from(chromaticities))
    except np.linalg.LinAlgError as error:
        raise ValueError("the chromaticities do not span a colour space") from error
    if not np.isfinite(matrix).all():
        raise ValueError("the chromaticities do not span a colour space")
    return np.asarray(matrix, np.float64)


def _xyz_from(chromaticities: tuple[float, ...]) -> NDArray[np.float64]:
    """Give the matrix from linear RGB to CIE XYZ in which white has Y = 1."""
    x, y = np.array(chromaticities, np.float64).reshape(4, 2).T
    corners = np.stack([x, y, 1 - x - y])
    if y[3] == 0:
        raise np.linalg.LinAlgError("white without luminance")
    weights = np.linalg.solve(corners[:, :3], corners[:, 3] / y[3])
    matrix: NDArray[np.float64] = corners[:, :3] * weights
    return matrix
