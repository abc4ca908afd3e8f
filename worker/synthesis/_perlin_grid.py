"""Fractal gradient noise on a regular grid of pixels, a few multiplications per pixel.

Within one row of lattice cells, with P_j(x) and Q_j(x) the parts of lattice line j that do not and
that do grow with the distance y from it, fade a and 0 <= y < 1 measured from the lower line 0,

    noise(x, y) = (1 - a(y)) (P_0 + y Q_0) + a(y) (P_1 + (y - 1) Q_1)
                = P_0 + y Q_0 + a(y) (P_1 - Q_1 - P_0) + y a(y) (Q_1 - Q_0).

The four terms in x are made once per row of cells, with all hashing and gradients; a row of pixels
is their weighted sum. Positions are reduced to cell and remainder in integers, and only lattice
indices wrap around, so the tile repeats bit for bit.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from worker.numba_kernel import kernel, parallel_kernel, prange
from worker.synthesis._perlin_octaves import SHIFT_UNITS
from worker.synthesis._perlin_points import hashed

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from worker.synthesis._perlin_octaves import Octave

    Floats = NDArray[np.float32]
    Indices = NDArray[np.int32]
    Single = float | np.float32

# Long rows are written fastest; the pixels of a block stay in the second-level cache while the
# octaves are added up.
BLOCK_WIDTH = 2048
BLOCK_HEIGHT = 128


class AxisTable(NamedTuple):
    """Where the pixels of one axis lie in each octave's lattice: arrays (octaves, pixels)."""

    cells: Indices
    offsets: Floats
    blends: Floats


def axis_table(
    octaves: Sequence[Octave], axis: int, pixels: NDArray[np.int64], size: int, fade: Floats
) -> AxisTable:
    """Tabulate pixel centres along u, v or w (axis 0, 1, 2) of a tile `size` pixels long.

    Cells rise from the first to the last pixel and go on beyond the tile without wrapping.
    """
    cells, offsets = [], []
    for octave in octaves:
        # (pixel + 1/2) / size * cells + shift / SHIFT_UNITS over one denominator
        denominator = 2 * SHIFT_UNITS * size
        numerator = (2 * pixels + 1) * (octave.cells * SHIFT_UNITS) + 2 * size * octave.shift[axis]
        cells.append(numerator // denominator)
        offsets.append(numerator % denominator / denominator)
    return AxisTable(np.array(cells, np.int32), *offsets_and_blends(np.array(offsets), fade))


def offsets_and_blends(offsets: NDArray[np.float64], fade: Floats) -> tuple[Floats, Floats]:
    """Return where in a cell places lie, 0..1, and how far its upper end has been blended in."""
    s = offsets
    blends = s * (fade[0] + s * (fade[1] + s * (fade[2] + s * (fade[3] + s * fade[4]))))
    return s.astype(np.float32), blends.astype(np.float32)


@parallel_kernel
def fill_fractal_noise(
    pixels: Floats,
    columns: AxisTable,
    lines: AxisTable,
    layers: Indices,
    periods: Indices,
    weights: Floats,
    bias: Single,
    table: Indices,
    gradients: Floats,
) -> None:
    """Write bias + sum of weighted octaves; `lines` count upwards, from the last row of pixels."""
    height, width = pixels.shape
    across = (width + BLOCK_WIDTH - 1) // BLOCK_WIDTH
    down = (height + BLOCK_HEIGHT - 1) // BLOCK_HEIGHT
    for block in prange(across * down):
        top = block // across * BLOCK_HEIGHT
        left = block % across * BLOCK_WIDTH
        bottom = min(top + BLOCK_HEIGHT, height)
        right = min(left + BLOCK_WIDTH, width)
        for n in range(len(weights)):
            _fill_block(
                pixels,
                bottom,
                left,
                columns.cells[n, left:right],
                columns.offsets[n, left:right],
                columns.blends[n, left:right],
                lines.cells[n, height - bottom : height - top],
                lines.offsets[n, height - bottom : height - top],
                lines.blends[n, height - bottom : height - top],
                layers[n],
                periods[n],
                weights[n],
                bias if n == 0 else np.float32(0),
                n > 0,
                table,
                gradients,
            )


@kernel
def _fill_block(
    pixels: Floats,
    bottom: int,
    left: int,
    column_cells: Indices,
    x: Floats,
    x_blends: Floats,
    line_cells: Indices,
    y: Floats,
    y_blends: Floats,
    layer: int,
    period: int,
    weight: float,
    bias: Single,
    accumulate: bool,
    table: Indices,
    gradients: Floats,
) -> None:
    height, width = len(y), len(x)
    first = column_cells[0]
    lattice_points = column_cells[-1] - first + 2
    columns = np.empty(width, np.uint32)
    for c in range(width):
        columns[c] = column_cells[c] - first
    gradient_x = np.empty(lattice_points, np.float32)
    gradient_y = np.empty(lattice_points, np.float32)
    level = np.empty((2, width), np.float32)
    slope = np.empty((2, width), np.float32)
    terms = np.empty((4, width), np.float32)
    lower = 0
    cell = -2
    for line in range(height):
        if line_cells[line] != cell:
            upper_is_ready = line_cells[line] == cell + 1
            cell = int(line_cells[line])
            if upper_is_ready:
                lower = 1 - lower
            else:
                _find_gradients(
                    gradient_x, gradient_y, first, cell, layer, period, table, gradients
                )
                _tabulate_level(level[lower], columns, x, x_blends, gradient_x)
                tabulate_slope(slope[lower], columns, x_blends, gradient_y)
            _find_gradients(
                gradient_x, gradient_y, first, cell + 1, layer, period, table, gradients
            )
            _tabulate_level(level[1 - lower], columns, x, x_blends, gradient_x)
            tabulate_slope(slope[1 - lower], columns, x_blends, gradient_y)
            combine(
                terms, level[lower], slope[lower], level[1 - lower], slope[1 - lower], weight, bias
            )
        # One row at a time: numba knows that a slice of a row is contiguous, of a block not
        row = pixels[bottom - 1 - line, left : left + width]
        if accumulate:
            add_row(row, terms[0], terms[1], terms[2], terms[3], y[line], y_blends[line])
        else:
            set_row(row, terms[0], terms[1], terms[2], terms[3], y[line], y_blends[line])


@kernel
def _find_gradients(
    gradient_x: Floats,
    gradient_y: Floats,
    first: int,
    line: int,
    layer: int,
    period: int,
    table: Indices,
    gradients: Floats,
) -> None:
    mask = len(gradients) - 1
    column, line = first % period, line % period
    for i in range(len(gradient_x)):
        number = hashed(column, line, layer, table) & mask
        gradient_x[i] = gradients[number, 0]
        gradient_y[i] = gradients[number, 1]
        column += 1
        if column == period:
            column = 0


@kernel
def _tabulate_level(
    level: Floats, columns: NDArray[np.uint32], x: Floats, x_blends: Floats, gradient_x: Floats
) -> None:
    next_gradient_x = gradient_x[1:]
    for c in range(len(level)):
        left = gradient_x[columns[c]] * x[c]
        right = next_gradient_x[columns[c]] * (x[c] - np.float32(1))
        level[c] = left + x_blends[c] * (right - left)


@kernel
def tabulate_slope(
    slope: Floats, columns: NDArray[np.uint32], x_blends: Floats, gradient_y: Floats
) -> None:
    """Write the slope of a row of lattice points along v at each column."""
    next_gradient_y = gradient_y[1:]
    for c in range(len(slope)):
        left = gradient_y[columns[c]]
        slope[c] = left + x_blends[c] * (next_gradient_y[columns[c]] - left)


@kernel
def combine(
    terms: Floats,
    level_0: Floats,
    slope_0: Floats,
    level_1: Floats,
    slope_1: Floats,
    weight: float,
    bias: Single,
) -> None:
    """Make the four terms of a row of cells from two lattice lines, times `weight`, plus `bias`."""
    width = len(level_0)
    for c in range(width):
        terms[0, c] = bias + weight * level_0[c]
    for c in range(width):
        terms[1, c] = weight * slope_0[c]
    for c in range(width):
        terms[2, c] = weight * (level_1[c] - slope_1[c] - level_0[c])
    for c in range(width):
        terms[3, c] = weight * (slope_1[c] - slope_0[c])


@kernel
def set_row(
    row: Floats, a: Floats, b: Floats, c: Floats, d: Floats, y: float, blend: float
) -> None:
    """Write a row of pixels at distance `y` from the lower lattice line."""
    both = y * blend
    for i in range(len(row)):
        row[i] = (a[i] + y * b[i]) + (blend * c[i] + both * d[i])


@kernel
def add_row(
    row: Floats, a: Floats, b: Floats, c: Floats, d: Floats, y: float, blend: float
) -> None:
    """Add to a row of pixels."""
    both = y * blend
    for i in range(len(row)):
        row[i] += (a[i] + y * b[i]) + (blend * c[i] + both * d[i])
