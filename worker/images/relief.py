"""Pictures of relief made ready for filtering: numbers of which means are meaningful."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from api_schemas.base import FLOAT32_MAX
from api_schemas.families import Wrap
from api_schemas.relief import BumpEncoding
from worker.images.image import Image
from worker.images.packed_floats import unpacked

_BYTE_MAX = 255


@dataclass(frozen=True, slots=True)
class Decoded:
    """Asks for the tilts that a bump map's texels mean."""

    encoding: BumpEncoding


@dataclass(frozen=True, slots=True)
class Slopes:
    """Asks for heights with their slopes: of one channel (0..3), where edges go on as wrapped."""

    channel: int
    wrap: tuple[Wrap, Wrap]


@dataclass(frozen=True, slots=True)
class Unpacked:
    """Asks for the numbers that four bytes hold."""


@dataclass(frozen=True, slots=True)
class Flat:
    """Asks for a picture as it is, and never for a volume."""


Preparation = Decoded | Slopes | Unpacked | Flat


def prepared(image: Image, preparation: Preparation | None) -> Image:
    """Return what a preparation asks for, or the picture itself.

    Decoded: two channels, tilts along u and v. Slopes: three channels: the height, and its change
    per tile along u and along v. Unpacked: one channel. What is no number is 0.
    """
    if preparation is None or isinstance(preparation, Flat):
        return image
    if isinstance(preparation, Unpacked):
        return Image(unpacked(image.pixels)[..., np.newaxis], "data")
    finite = np.nan_to_num(image.pixels, posinf=FLOAT32_MAX, neginf=-FLOAT32_MAX)
    if isinstance(preparation, Decoded):
        pair = finite[..., [0, min(1, image.channels - 1)]]
        return Image(decode(pair, preparation.encoding), "data")
    channel = 0 if image.channels == 1 and preparation.channel < 3 else preparation.channel
    if channel >= image.channels:
        flat = np.zeros((*finite.shape[:2], 3), dtype=np.float32)
        flat[..., 0] = preparation.channel == 3  # a missing alpha is 1
        return Image(flat, "data")
    return Image(with_slopes(finite[..., channel], preparation.wrap), "data")


def decode(texels: NDArray[np.floating], encoding: BumpEncoding) -> NDArray[np.float32]:
    """Give the numbers -1..1 that texels mean; a byte B is B / 255.

    snorm8: the byte R in two's complement, max(R, -127) / 127, so that -128 and -127 are both -1;
    unorm8: 2 B / 255 - 1, which is never 0; float: as they are.

    Source: Hughes et al., 2013, section 20.2.
    """
    if encoding == "float":
        return texels.astype(np.float32)
    values = texels.astype(np.float64)
    if encoding == "unorm8":
        return np.clip(2 * values - 1, -FLOAT32_MAX, FLOAT32_MAX).astype(np.float32)
    byte = np.rint(np.clip(values, 0, 1) * _BYTE_MAX)
    signed = np.where(byte > 127, byte - 256, byte)
    return (np.maximum(signed, -127) / 127).astype(np.float32)


def with_slopes(heights: NDArray[np.float32], wrap: tuple[Wrap, Wrap]) -> NDArray[np.float32]:
    """Give heights (h, w) with their central differences, per tile: float32 (h, w, 3).

    Beyond an edge that does not repeat, its own texel goes on.
    """
    wide = heights.astype(np.float64)
    height, width = wide.shape
    right = _rise(wide, wrap[0]) * width
    up = -_rise(wide.T, wrap[1]).T * height
    known: NDArray[np.float64] = np.stack([wide, right, up], axis=2)
    return np.clip(known, -FLOAT32_MAX, FLOAT32_MAX).astype(np.float32)


def _rise(values: NDArray[np.float64], wrap: Wrap) -> NDArray[np.float64]:
    """Return half the difference between the texels after and before each one of a row."""
    after, before = np.roll(values, -1, axis=1), np.roll(values, 1, axis=1)
    if wrap != "repeat":
        after[:, -1], before[:, 0] = values[:, -1], values[:, 0]
    return after / 2 - before / 2
