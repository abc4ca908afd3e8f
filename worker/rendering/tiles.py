"""Cut a picture into tiles that fit a bounded framebuffer."""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

SAMPLES_MAX = 2048


@dataclass(frozen=True, slots=True)
class Tile:
    """A rectangle of pixels, counted from the lower left corner of the picture as OpenGL does."""

    left: int
    bottom: int
    width: int
    height: int


def pixels_per_tile(supersampling: int) -> int:
    """Return a tile's side in pixels: even, so that no 2 x 2 block of derivatives is cut."""
    return SAMPLES_MAX // supersampling // 2 * 2


def tiles(width: int, height: int, supersampling: int) -> Iterator[Tile]:
    """Cut a picture of so many pixels into tiles of at most 2048 x 2048 samples, row by row."""
    side = pixels_per_tile(supersampling)
    for bottom in range(0, height, side):
        for left in range(0, width, side):
            yield Tile(left, bottom, min(side, width - left), min(side, height - bottom))


def tile_from_picture(tile: Tile, width: int, height: int) -> NDArray[np.float64]:
    """Give the 4 x 4 matrix that stretches the tile's part of clip space over all of it."""
    matrix = np.eye(4)
    for axis, start, length, whole in (
        (0, tile.left, tile.width, width),
        (1, tile.bottom, tile.height, height),
    ):
        matrix[axis, axis] = whole / length
        matrix[axis, 3] = (whole - 2 * start - length) / length
    return matrix
