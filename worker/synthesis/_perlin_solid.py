"""Fractal gradient noise in space and time on a regular grid, a few multiplications per voxel.

Within one slice of voxels, at distance z and blend c from the lower of two lattice slices, the
parts of a lattice line that do not and that do grow with the distance from it along v are those of
both slices blended:

    P_j = (1 - c) (P_j0 + z Qz_j0) + c (P_j1 + (z - 1) Qz_j1),    Q_j = (1 - c) Q_j0 + c Q_j1.

With time there are four lattice slices to blend instead of two. From there on a slice is made like
a picture, row by row (`_perlin_grid`).
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from worker.numba_kernel import kernel, parallel_kernel, prange
from worker.synthesis._perlin_grid import (
    BLOCK_HEIGHT,
    AxisTable,
    add_row,
    combine,
    offsets_and_blends,
    set_row,
    tabulate_slope,
)
from worker.synthesis._perlin_points import hashed

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from worker.synthesis._perlin_grid import Floats, Indices, Single


def place_table(place: float, cells: Sequence[int], fade: Floats) -> AxisTable:
    """Tabulate a single place, in tiles, or moment, in turns, in lattices of so many cells."""
    x = np.multiply(place - np.floor(place), cells)[:, np.newaxis]
    whole = np.floor(x)
    return AxisTable(whole.astype(np.int32), *offsets_and_blends(x - whole, fade))


@parallel_kernel
def fill_fractal_solid(
    voxels: Floats,
    columns: AxisTable,
    lines: AxisTable,
    slices: AxisTable,
    moment: AxisTable,
    layers: Indices,
    periods: Indices,
    beats: Indices,
    weights: Floats,
    bias: Single,
    table: Indices,
    gradients: Floats,
) -> None:
    """Write bias + sum of weighted octaves into (depth, height, width).

    `lines` count upwards, from the last row of a slice; the lattice slices of octave n are those of
    the noise from number `layers[n]` on; `moment` has one place. `gradients` are the sixteen of
    space or the 32 of space and time.
    """
    depth, height, _ = voxels.shape
    down = (height + BLOCK_HEIGHT - 1) // BLOCK_HEIGHT
    for block in prange(depth * down):
        index = block // down
        top = block % down * BLOCK_HEIGHT
        bottom = min(top + BLOCK_HEIGHT, height)
        for n in range(len(weights)):
            _fill_slice(
                voxels[index, top:bottom],
                columns.cells[n],
                columns.offsets[n],
                columns.blends[n],
                lines.cells[n, height - bottom : height - top],
                lines.offsets[n, height - bottom : height - top],
                lines.blends[n, height - bottom : height - top],
                (slices.cells[n, index], moment.cells[n, 0]),
                (slices.offsets[n, index], moment.offsets[n, 0]),
                (slices.blends[n, index], moment.blends[n, 0]),
                layers[n],
                (periods[n], beats[n]),
                weights[n],
                bias if n == 0 else np.float32(0),
                n > 0,
                table,
                gradients,
            )


@kernel
def _fill_slice(
    pixels: Floats,
    column_cells: Indices,
    x: Floats,
    x_blends: Floats,
    line_cells: Indices,
    y: Floats,
    y_blends: Floats,
    cells: tuple[int, int],
    offsets: tuple[Single, Single],
    blends: tuple[Single, Single],
    layer: int,
    periods: tuple[int, int],
    weight: float,
    bias: Single,
    accumulate: bool,
    table: Indices,
    gradients: Floats,
) -> None:
    """Write one slice; pairs are along w and along time."""
    height, width = pixels.shape
    first = column_cells[0]
    columns = np.empty(width, np.uint32)
    for c in range(width):
        columns[c] = column_cells[c] - first
    # At lattice points: what grows along u and v, and what does not within this slice
    along_u = np.empty(column_cells[-1] - first + 2, np.float32)
    along_v = np.empty_like(along_u)
    still = np.empty_like(along_u)
    level = np.empty((2, width), np.float32)
    slope = np.empty((2, width), np.float32)
    terms = np.empty((4, width), np.float32)
    lower = 0
    cell = -2
    for line in range(height):
        if line_cells[line] != cell:
            ready = line_cells[line] == cell + 1
            cell = int(line_cells[line])
            lower = 1 - lower if ready else lower
            for side in range(1 if ready else 0, 2):
                target = lower if side == 0 else 1 - lower
                _blend_gradients(
                    along_u,
                    along_v,
                    still,
                    first,
                    cell + side,
                    cells,
                    offsets,
                    blends,
                    layer,
                    periods,
                    table,
                    gradients,
                )
                _tabulate_level(level[target], columns, x, x_blends, along_u, still)
                tabulate_slope(slope[target], columns, x_blends, along_v)
            combine(
                terms, level[lower], slope[lower], level[1 - lower], slope[1 - lower], weight, bias
            )
        row = pixels[height - 1 - line]
        if accumulate:
            add_row(row, terms[0], terms[1], terms[2], terms[3], y[line], y_blends[line])
        else:
            set_row(row, terms[0], terms[1], terms[2], terms[3], y[line], y_blends[line])


@kernel
def _blend_gradients(
    along_u: Floats,
    along_v: Floats,
    still: Floats,
    first: int,
    line: int,
    cells: tuple[int, int],
    offsets: tuple[Single, Single],
    blends: tuple[Single, Single],
    layer: int,
    periods: tuple[int, int],
    table: Indices,
    gradients: Floats,
) -> None:
    timed = len(gradients) == 32
    mask = len(gradients) - 1
    one = np.float32(1)
    along_u[:] = 0
    along_v[:] = 0
    still[:] = 0
    for corner in range(4 if timed else 2):
        away, later = corner & 1, corner >> 1
        weight = blends[0] if away else one - blends[0]
        if timed:
            weight *= blends[1] if later else one - blends[1]
        z, t = offsets[0] - np.float32(away), offsets[1] - np.float32(later)
        number = (cells[0] + away) % periods[0] + layer
        moment = (cells[1] + later) % periods[1]
        column, row = first % periods[0], line % periods[0]
        for i in range(len(along_u)):
            point = hashed(column, row, number, table)
            if timed:
                point = table[(point + moment) & 255]
            gradient = gradients[point & mask]
            along_u[i] += weight * gradient[0]
            along_v[i] += weight * gradient[1]
            still[i] += weight * (gradient[2] * z + gradient[3] * t)
            column += 1
            if column == periods[0]:
                column = 0


@kernel
def _tabulate_level(
    level: Floats,
    columns: NDArray[np.uint32],
    x: Floats,
    x_blends: Floats,
    along_u: Floats,
    still: Floats,
) -> None:
    next_along_u, next_still = along_u[1:], still[1:]
    for c in range(len(level)):
        left = along_u[columns[c]] * x[c] + still[columns[c]]
        right = next_along_u[columns[c]] * (x[c] - np.float32(1)) + next_still[columns[c]]
        level[c] = left + x_blends[c] * (right - left)
