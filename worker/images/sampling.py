"""Pictures read at any place, as shaders read them: wrapped, smooth, in levels of detail."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from api_schemas.families import Wrap

    Floats = NDArray[np.float64]
    Indices = NDArray[np.int64]

_FARTHEST = 2.0**40
"""Tiles beyond which a place has no digits left for where in a tile it is."""


def sample(
    levels: Sequence[NDArray[np.float32]],
    places: Floats,
    wrap: tuple[Wrap, Wrap],
    *,
    border: float = 0.0,
    smooth: bool = True,
    detail: Floats | None = None,
) -> Floats:
    """Read one channel of a picture at many places.

    Args:
        levels: (height, width) each, level 0 first, row 0 at the top.
        places: (n, 2), u to the right and v up, one tile from 0 to 1.
        wrap: What lies beyond the tile along u and v.
        border: What is read there where that is a border.
        smooth: Blend the four texels round a place; else take the one that covers it.
        detail: (n,), the level wanted for each place, between two of which is blended; 0 without.

    Returns:
        (n,), in float64.
    """
    places = np.clip(places, -_FARTHEST, _FARTHEST)
    if detail is None:
        return _read(levels[0], places, wrap, border, smooth)
    wanted = np.clip(detail, 0, len(levels) - 1)
    lower = np.minimum(np.floor(wanted).astype(np.int64), max(len(levels) - 2, 0))
    share = wanted - lower
    found = np.empty(len(places))
    for level in np.unique(lower):
        here = lower == level
        fine = _read(levels[level], places[here], wrap, border, smooth)
        coarser = levels[min(level + 1, len(levels) - 1)]
        coarse = _read(coarser, places[here], wrap, border, smooth)
        found[here] = fine + share[here] * (coarse - fine)
    return found


def _read(
    picture: NDArray[np.float32],
    places: Floats,
    wrap: tuple[Wrap, Wrap],
    border: float,
    smooth: bool,
) -> Floats:
    height, width = picture.shape
    texels = places * (width, height) - (0.5 if smooth else 0.0)
    corner = np.floor(texels)
    right, up = (texels - corner).T
    column, row = corner.astype(np.int64).T

    def texel(column: Indices, row: Indices) -> Floats:
        x, outside_x = _wrapped(column, width, wrap[0])
        y, outside_y = _wrapped(row, height, wrap[1])
        values = picture[height - 1 - y, x].astype(np.float64)
        return np.where(outside_x | outside_y, border, values)

    if not smooth:
        return texel(column, row)
    lower = texel(column, row) * (1 - right) + texel(column + 1, row) * right
    upper = texel(column, row + 1) * (1 - right) + texel(column + 1, row + 1) * right
    blended: Floats = lower * (1 - up) + upper * up
    return blended


def _wrapped(index: Indices, length: int, wrap: Wrap) -> tuple[Indices, NDArray[np.bool_]]:
    """Return indices within 0..length - 1, and which of them stand for a border."""
    if wrap == "repeat":
        return index % length, np.zeros(len(index), dtype=bool)
    if wrap == "mirror":
        within = index % (2 * length)
        return np.minimum(within, 2 * length - 1 - within), np.zeros(len(index), dtype=bool)
    inside = np.clip(index, 0, length - 1)
    return inside, (inside != index) & (wrap == "border")
