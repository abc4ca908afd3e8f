"""Pictures and volumes read at any place, as shaders read them: wrapped, smooth, in levels."""

from __future__ import annotations

from itertools import product
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
    wrap: Sequence[Wrap],
    *,
    border: float = 0.0,
    smooth: bool = True,
    detail: Floats | None = None,
) -> Floats:
    """Read one channel of a picture, or of a volume, at many places.

    Args:
        levels: (height, width) or (depth, height, width) each, level 0 first, row 0 at the top.
        places: (n, 2) or (n, 3): u to the right, v up, and w from the first slice to the last one;
            one tile from 0 to 1.
        wrap: What lies beyond the tile along each.
        border: What is read there where that is a border.
        smooth: Blend the texels round a place; else take the one that covers it.
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
    texels: NDArray[np.float32],
    places: Floats,
    wrap: Sequence[Wrap],
    border: float,
    smooth: bool,
) -> Floats:
    at = places * texels.shape[::-1] - (0.5 if smooth else 0.0)
    corner = np.floor(at)
    share = at - corner
    found = np.zeros(len(places))
    for step in product((0, 1), repeat=places.shape[1]) if smooth else [(0,) * places.shape[1]]:
        weight = np.prod(np.where(step, share, 1 - share), axis=1) if smooth else 1.0
        found += weight * _texel(texels, corner.astype(np.int64) + step, wrap, border)
    return found


def _texel(
    texels: NDArray[np.float32], index: Indices, wrap: Sequence[Wrap], border: float
) -> Floats:
    """Return the texels (n,) at numbers (n, 2) or (n, 3), counted from the left and from below."""
    inside, outside = [], np.zeros(len(index), dtype=bool)
    for number, length, mode in zip(index.T, texels.shape[::-1], wrap, strict=True):
        within, beyond = _wrapped(number, length, mode)
        inside.append(within)
        outside |= beyond
    inside[1] = texels.shape[-2] - 1 - inside[1]
    return np.where(outside, border, texels[tuple(inside[::-1])].astype(np.float64))


def _wrapped(index: Indices, length: int, wrap: Wrap) -> tuple[Indices, NDArray[np.bool_]]:
    """Return indices within 0..length - 1, and which of them stand for a border."""
    if wrap == "repeat":
        return index % length, np.zeros(len(index), dtype=bool)
    if wrap == "mirror":
        within = index % (2 * length)
        return np.minimum(within, 2 * length - 1 - within), np.zeros(len(index), dtype=bool)
    inside = np.clip(index, 0, length - 1)
    return inside, (inside != index) & (wrap == "border")
