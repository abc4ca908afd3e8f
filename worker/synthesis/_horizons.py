"""How much of an even sky each point of a relief sees, between its horizons.

For each pair of opposite directions the horizons are the steepest lines of sight to what stands
around (Max, 1988), and what lies between them is weighed by the cosine to the normal in closed form
(Jimenez et al., 2016).
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from api_schemas.textures.material_from_height import DIRECTIONS
from worker.numba_kernel import kernel, parallel_kernel, prange

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Field = NDArray[np.float64]


def sky_seen(relief: Field, normals: Field, reach: float) -> Field:
    """Return the share of the sky, 0..1, each part weighed by the cosine to the normal.

    Args:
        relief: Heights in tiles, (height, width), row 0 the top; its edges are joined.
        normals: Of length one, (height, width, 3), x along u, y along v.
        reach: How far one looks, in tiles.
    """
    seen = np.empty_like(relief)
    steps = int(np.ceil(reach * max(relief.shape)))
    _fill_seen(seen, relief, normals, steps, reach / max(steps, 1))
    return seen


def warm() -> None:
    """Compile the kernels."""
    sky_seen(np.zeros((2, 2)), np.zeros((2, 2, 3)), 0.5)


@parallel_kernel
def _fill_seen(seen: Field, relief: Field, normals: Field, steps: int, stride: float) -> None:
    height, width = relief.shape
    slices = DIRECTIONS // 2
    for row in prange(height):
        for column in range(width):
            normal = normals[row, column]
            total = 0.0
            for index in range(slices):
                angle = np.pi * (index + 0.5) / slices
                u, v = np.cos(angle), np.sin(angle)
                ahead = _horizon(relief, row, column, u * stride, v * stride, steps)
                behind = _horizon(relief, row, column, -u * stride, -v * stride, steps)
                along = normal[0] * u + normal[1] * v
                length = np.sqrt(along * along + normal[2] * normal[2])
                lean = np.arctan2(along, normal[2])
                last = min(np.pi / 2 - np.arctan(ahead), lean + np.pi / 2)
                first = max(np.arctan(behind) - np.pi / 2, lean - np.pi / 2)
                total += length * (_arc(first, lean) + _arc(last, lean))
            seen[row, column] = min(max(total / slices, 0.0), 1.0)


@kernel
def _arc(horizon: float, lean: float) -> float:
    """Return the integral from straight up to a horizon of cos(angle - lean) |sin(angle)|."""
    arc: float = (np.cos(lean) - np.cos(2 * horizon - lean) + 2 * horizon * np.sin(lean)) / 4
    return arc


@kernel
def _horizon(relief: Field, row: int, column: int, u: float, v: float, steps: int) -> float:
    """Return the steepest slope to what stands in a direction, strides of (u, v) tiles apart."""
    height, width = relief.shape
    here, steepest = relief[row, column], -1e300
    stride = np.sqrt(u * u + v * v)
    for step in range(1, steps + 1):
        x, y = column + step * u * width, row - step * v * height
        left, top = np.floor(x), np.floor(y)
        c, r = int(left) % width, int(top) % height
        right, below = (c + 1) % width, (r + 1) % height
        x, y = x - left, y - top
        upper = (1 - x) * relief[r, c] + x * relief[r, right]
        lower = (1 - x) * relief[below, c] + x * relief[below, right]
        steepest = max(steepest, ((1 - y) * upper + y * lower - here) / (step * stride))
    return steepest
