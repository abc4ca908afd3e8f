"""Solid angles of texels by the middles of many parts of each."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Callable

    from numpy.typing import NDArray

    Numbers = NDArray[np.float64]

_MOST_PARTS = 8
_MOST_PLACES = 1 << 24
_ROWS = 64


def sum_of_parts(density: Callable[[Numbers], Numbers], width: int, height: int) -> Numbers:
    """Return the integral of a density over each texel, float64 (height, width).

    Args:
        density: Steradians per unit of the picture's area, (n,), at places (u, v), (n, 2).
        width: Texels across.
        height: Texels down; row 0 is the top.
    """
    side = max(1, min(_MOST_PARTS, math.isqrt(_MOST_PLACES // (width * height))))
    u = (np.arange(width * side) + 0.5) / (width * side)
    found = np.empty((height, width))
    for top in range(0, height, _ROWS):
        rows = min(_ROWS, height - top)
        v = 1 - (np.arange(top * side, (top + rows) * side) + 0.5) / (height * side)
        places = np.stack(np.meshgrid(u, v), axis=-1).reshape(-1, 2)
        parts = density(places).reshape(rows, side, width, side)
        found[top : top + rows] = parts.mean(axis=(1, 3))
    return found / (width * height)
