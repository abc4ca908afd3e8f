"""Squares of two colours (Hughes et al., 2013, section 20.7), averaged exactly over each pixel.

With S = +1 on [0, 1) and -1 on [1, 2), repeated, the colour at (x, y) in squares is the first one
with share (1 + S(x) S(y)) / 2 and the second one for the rest; in a solid of cubes S(z) is a third
factor. The mean of S over [a, b] is
(T(b) - T(a)) / (b - a) with its integral, the triangle wave T(x) = 1 - |1 - (x mod 2)|.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from worker.images.image import Image
from worker.images.volume import Volume
from worker.synthesis._two_colors import blended

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from numpy.typing import NDArray

    from api_schemas.textures.checkerboard import CheckerboardSpec
    from worker.closed_form import Parameter
    from worker.stages import Report


def synthesize(
    spec: CheckerboardSpec, size: tuple[int, int], inputs: Mapping[str, Image], report: Report
) -> Image:
    """Average the tile over each pixel of (width, height); the lower left square has colors[0]."""
    width, height = size
    down = _mean_signs(spec.cells[1], height)[::-1]
    return Image(blended(spec.colors, _mean_signs(spec.cells[0], width), down), spec.meaning)


def synthesize_volume(
    spec: CheckerboardSpec, size: tuple[int, int, int], inputs: Mapping[str, Volume], report: Report
) -> Volume:
    """Average the solid tile over each voxel of (width, height, depth)."""
    width, height, depth = size
    down = _mean_signs(spec.cells[1], height)[::-1]
    away = _mean_signs(_cells(spec)[2], depth)
    rows = blended(spec.colors, _mean_signs(spec.cells[0], width), np.outer(away, down).ravel())
    return Volume(rows.reshape(depth, height, width, -1), spec.meaning)


def color_at(
    spec: CheckerboardSpec, places: NDArray[np.float64], reach: Sequence[float]
) -> NDArray[np.float64]:
    """Return colours (n, 3) averaged over boxes around points of the plane or of space.

    Args:
        spec: The colours.
        places: (n, 2) or (n, 3), in tiles.
        reach: Lengths of a box along each axis, in tiles; without one there is no average.
    """
    signs = np.ones(len(places))
    for place, cells, length in zip(places.T, _cells(spec), reach, strict=False):
        x, half = (place - np.floor(place)) * cells, 0.5 * cells * length
        if half:
            signs *= (_triangle(x + half) - _triangle(x - half)) / (2 * half)
        else:
            signs *= 1 - 2 * (np.floor(x) % 2)
    share = (0.5 + 0.5 * signs)[:, np.newaxis]
    first, second = np.array(spec.colors, np.float32).astype(np.float64)
    colors: NDArray[np.float64] = share * first + (1 - share) * second
    return colors


def closed_form(spec: CheckerboardSpec, *, solid: bool) -> Mapping[str, Parameter]:
    """Return cells along each axis, none along w in a plane, and the colours."""
    cells = np.array(_cells(spec), np.float32) * (1, 1, solid)
    first, second = np.array(spec.colors, np.float32)
    return {"cells": cells, "first": first, "second": second}


def _cells(spec: CheckerboardSpec) -> tuple[int, int, int]:
    u, v, w = (spec.cells * 2)[:3]
    return u, v, w


def _triangle(x: NDArray[np.float64]) -> NDArray[np.float64]:
    return 1 - abs(1 - x % 2)


def _mean_signs(cells: int, pixels: int) -> NDArray[np.float64]:
    """Return the mean of S over each of `pixels` equal parts of `cells` squares.

    The triangle wave is taken in integers, in units of 1 / pixels, hence without rounding.
    """
    edges = np.arange(pixels + 1) * cells % (2 * pixels)
    triangle = pixels - abs(pixels - edges)
    return np.diff(triangle) / cells
