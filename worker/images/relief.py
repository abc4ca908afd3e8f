"""Pictures of relief made ready for filtering: numbers of which means are meaningful."""

from dataclasses import dataclass
from typing import Literal

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
    """Asks for the tilts that a bump map's texels mean, and for the sum of their squares."""

    encoding: BumpEncoding
    squares: bool = False


@dataclass(frozen=True, slots=True)
class Normals:
    """Asks for unit normals, of 0..1 with .5 for none or of the numbers themselves.

    Or as slopes: with z made 1.
    """

    range: Literal["unit", "signed"]
    slopes: bool = False


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


@dataclass(frozen=True, slots=True)
class Products:
    """Asks for the products of the slopes that another preparation gives (Olano and Baker, 2010).

    Their means less the products of the means tell how slopes vary, and along which direction.
    """

    of: Decoded | Normals | Slopes


Preparation = Decoded | Normals | Slopes | Products | Unpacked | Flat
_STEEPEST = 100.0
"""Slope of a normal that lies in the surface."""


def prepared(image: Image, preparation: Preparation | None) -> Image:
    """Return what a preparation asks for, or the picture itself.

    Decoded: two channels, tilts along u and v, and their squares' sum if asked for. Normals: three
    channels of unit length, upright where there is none. Slopes: three channels: the height, and
    its change per tile along u and along v. Products: three channels, of the slopes along u and v:
    u u, u v and v v. Unpacked: one channel. What is no number is 0.
    """
    if isinstance(preparation, Products):
        known = prepared(image, preparation.of).pixels.astype(np.float64)
        first = 1 if isinstance(preparation.of, Slopes) else 0
        u, v = known[..., first], known[..., first + 1]
        products = np.clip(np.stack([u * u, u * v, v * v], axis=-1), -FLOAT32_MAX, FLOAT32_MAX)
        return Image(products.astype(np.float32), "data")
    if preparation is None or isinstance(preparation, Flat):
        return image
    if isinstance(preparation, Unpacked):
        return Image(unpacked(image.pixels)[..., np.newaxis], "data")
    finite = np.nan_to_num(image.pixels, posinf=FLOAT32_MAX, neginf=-FLOAT32_MAX)
    if isinstance(preparation, Decoded):
        pair = decode(finite[..., [0, min(1, image.channels - 1)]], preparation.encoding)
        return Image(with_squares(pair) if preparation.squares else pair, "data")
    if isinstance(preparation, Normals):
        normals = unit_normals(_xyz(finite), preparation.range)
        return Image(_over_z(normals) if preparation.slopes else normals, "data")
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


def with_squares(tilts: NDArray[np.float32]) -> NDArray[np.float32]:
    """Give tilts (h, w, 2) with the sum of their squares, of which means tell how they vary."""
    squares = np.square(tilts.astype(np.float64)).sum(axis=-1, keepdims=True)
    known: NDArray[np.float64] = np.concatenate([tilts, squares], axis=-1)
    return np.clip(known, -FLOAT32_MAX, FLOAT32_MAX).astype(np.float32)


def unit_normals(
    texels: NDArray[np.floating], number_range: Literal["unit", "signed"]
) -> NDArray[np.float32]:
    """Give the unit vectors (h, w, 3) that texels mean; what has no length is (0, 0, 1)."""
    held = texels.astype(np.float64)
    if number_range == "unit":
        held = 2 * held - 1
    held /= np.maximum(np.abs(held).max(axis=-1, keepdims=True), 1e-30)
    length = np.linalg.norm(held, axis=-1, keepdims=True)
    upright = np.array([0.0, 0.0, 1.0])
    unit = np.where(length > 0, held / np.where(length > 0, length, 1), upright)
    return np.asarray(unit, dtype=np.float32)


def _over_z(normals: NDArray[np.float32]) -> NDArray[np.float32]:
    over = np.ones_like(normals)
    over[..., :2] = normals[..., :2] / np.maximum(normals[..., 2:], 1 / _STEEPEST)
    return over


def _xyz(pixels: NDArray[np.float32]) -> NDArray[np.float32]:
    """Return three channels as a shader reads them: grey is all of them, a missing blue is 0."""
    channels = pixels.shape[-1]
    if channels == 1:
        return np.repeat(pixels, 3, axis=-1)
    missing = np.zeros((*pixels.shape[:-1], max(3 - channels, 0)), dtype=np.float32)
    return np.concatenate([pixels[..., :3], missing], axis=-1)


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
