"""Mip chains: a picture at half, a quarter, an eighth ... of its size, the mean kept on each."""

import numpy as np
from numpy.typing import NDArray


def mip_chain(pixels: NDArray[np.float32]) -> list[NDArray[np.float32]]:
    """Give the picture and its box means down to one texel (Williams 1983).

    There are floor(log2 max(W, H)) + 1 levels; a side of n texels becomes max(1, floor(n / 2)), as
    GL wants. Each texel is the mean of the area it covers, so that every level has the mean
    of the first up to float32 rounding, odd sides included (Guthe and Heckbert 2005).

    Args:
        pixels: float32, shape (H, W, C), linear light, alpha premultiplied. Level 0 is this array.
    """
    levels = [pixels]
    while max(levels[-1].shape[:2]) > 1:
        levels.append(_halve_width(_halve_height(levels[-1])))
    return levels


def _halve_height(pixels: NDArray[np.float32]) -> NDArray[np.float32]:
    height = pixels.shape[0]
    if height == 1:
        return pixels
    if height % 2 == 0:
        return (pixels[0::2] + pixels[1::2]) * np.float32(0.5)
    first, middle, last = (weights[:, None, None] for weights in _odd_weights(height))
    halved: NDArray[np.float32] = first * pixels[0:-2:2]
    halved += middle * pixels[1:-1:2]
    halved += last * pixels[2::2]
    return halved


def _halve_width(pixels: NDArray[np.float32]) -> NDArray[np.float32]:
    width = pixels.shape[1]
    if width == 1:
        return pixels
    halved = np.empty((pixels.shape[0], width // 2, pixels.shape[2]), np.float32)
    # Channel by channel: numpy's inner loop then runs along a row, not over four numbers.
    for channel in range(pixels.shape[2]):
        row, out = pixels[:, :, channel], halved[:, :, channel]
        if width % 2 == 0:
            np.add(row[:, 0::2], row[:, 1::2], out=out)
            out *= np.float32(0.5)
        else:
            first, middle, last = _odd_weights(width)
            np.multiply(middle, row[:, 1:-1:2], out=out)
            out += first * row[:, 0:-2:2]
            out += last * row[:, 2::2]
    return halved


def _odd_weights(
    side: int,
) -> tuple[NDArray[np.float32], NDArray[np.float32], NDArray[np.float32]]:
    """Weigh the three texels under each texel of the next level, for a side of 2m + 1 texels.

    Texel j covers (2m + 1)/m texels from j (2m + 1)/m on: the parts are (m - j), m and (j + 1)
    of 2m + 1.
    """
    half = side // 2
    texel = np.arange(half, dtype=np.float64)
    parts = (half - texel, np.full(half, float(half)), texel + 1)
    first, middle, last = ((part / side).astype(np.float32) for part in parts)
    return first, middle, last
