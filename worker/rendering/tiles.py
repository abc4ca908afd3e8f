"""Cut a picture into bands of tiles that fit a bounded framebuffer."""

import math
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from api_schemas.output import SIDE_MAX

SAMPLES_MAX = 2048 * 2048
"""Samples of a tile: a picture's take 84 MB with their depth."""
LAYERED_SAMPLES_MAX = 1024 * 1024
"""The same with all layers: 138 MB, and 134 MB for the pixels they are resolved to."""


@dataclass(frozen=True, slots=True)
class Tile:
    """A rectangle of pixels, counted from the lower left corner of the picture as OpenGL does."""

    left: int
    bottom: int
    width: int
    height: int


def tile_size(
    width: int, height: int, supersampling: int, samples_max: int, apron: int = 0
) -> tuple[int, int]:
    """Return width and height in pixels of the tiles of a picture of so many pixels.

    Tiles are about as wide as a framebuffer may be, so that few of them make the rows of a band.
    Their sides are those of the picture or even, so that no 2 x 2 block of derivatives is cut.
    There is room for an apron of pixels all round.
    """
    side = SIDE_MAX // supersampling // 2 * 2 - 2 * apron
    columns = math.ceil(width / side)
    tile_width = min(width, math.ceil(width / columns / 2) * 2)
    rows = min(side, samples_max // ((tile_width + 2 * apron) * supersampling**2) - 2 * apron)
    return tile_width, min(height, max(2, rows // 2 * 2))


def bands(width: int, height: int, size: tuple[int, int]) -> Iterator[list[Tile]]:
    """Cut a picture into bands, the topmost first, and each band into tiles, the leftmost first.

    Args:
        width: Of the picture in pixels.
        height: Of the picture in pixels.
        size: Of the largest tile; what is left over goes to the uppermost and rightmost ones.
    """
    tile_width, tile_height = size
    for bottom in reversed(range(0, height, tile_height)):
        yield [
            Tile(left, bottom, min(tile_width, width - left), min(tile_height, height - bottom))
            for left in range(0, width, tile_width)
        ]


def widened(tile: Tile, apron: int) -> Tile:
    """Return a tile with so many pixels more on every side, beyond the picture too."""
    return Tile(
        tile.left - apron, tile.bottom - apron, tile.width + 2 * apron, tile.height + 2 * apron
    )


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
