"""A dish of grid cells with a rim: what is in it at first, and what lies beyond its edges.

Cells are (chemicals, height + 2, width + 2): the outermost rows and columns are the rim, which is
filled before each step, so that every step treats all cells of the dish alike.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, TypeAlias

import numpy as np

from api_schemas.dishes import mapped
from worker.numba_kernel import kernel
from worker.synthesis._counter_hash import uniforms
from worker.synthesis._pointwise import wide
from worker.synthesis._resample import resample

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from numpy.typing import NDArray

    from api_schemas.dishes import CellsSpec, DishSpec
    from worker.images.image import Image

Cells: TypeAlias = "NDArray[np.float64]"
Rows: TypeAlias = "NDArray[np.float64]"
"""One row for all or one for each, with the rim's columns: (1 or height, width + 2)."""
Row: TypeAlias = "NDArray[np.float64]"


@kernel
def at(rows: Rows, row: int) -> Row:
    """Return what a parameter is along a row of cells, of which 0 is the rim."""
    one: Row = rows[min(row - 1, len(rows) - 1)]
    return one


@kernel
def spread(after: Cells, before: Cells, diffusions: tuple[Rows, ...], time_step: float) -> None:
    """Let every chemical spread for one step, by the five-point Laplacian."""
    chemicals, height, _ = before.shape
    for row in range(1, height - 1):
        for chemical in range(chemicals):
            rates = at(diffusions[chemical], row)
            c = before[chemical]
            _spread_row(after[chemical, row], c[row - 1], c[row], c[row + 1], rates, time_step)


@kernel
def _spread_row(after: Row, above: Row, c: Row, below: Row, rates: Row, time_step: float) -> None:
    for x in range(1, len(c) - 1):
        around = above[x] + below[x] + c[x - 1] + c[x + 1]
        after[x] = c[x] + time_step * rates[x] * (around - 4.0 * c[x])


def parameter_rows(spec: CellsSpec, inputs: Mapping[str, Image]) -> dict[str, Rows]:
    """Return every parameter by name."""
    return {name: rows_of(spec, name, inputs) for name in spec.parameters}


def rows_of(spec: CellsSpec, name: str, inputs: Mapping[str, Image]) -> Rows:
    """Return a parameter, from its number or from the picture of its texture."""
    by = mapped(spec, name)
    if by is None:
        return np.full((1, spec.size[0] + 2), getattr(spec, name), np.float64)
    low, high = by.range
    share = np.clip(channels(spec, inputs[name])[0], 0, 1)
    return with_rim(low + (high - low) * share)


def channels(spec: CellsSpec, image: Image) -> NDArray[np.float64]:
    """Return a picture, brought to the size of the dish, as (channels, height, width)."""
    pixels = resample(image.pixels, (spec.size[0], spec.size[1]))
    return np.ascontiguousarray(wide(pixels).transpose(2, 0, 1))


def with_rim(field: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return rows with a column more at both ends."""
    return np.pad(field, ((0, 0), (1, 1)))


def dish_at(spec: DishSpec, rest: Sequence[float], inputs: Mapping[str, Image]) -> Cells:
    """Return a dish at rest, but for the chemicals that the picture to start from has."""
    width, height = spec.size
    cells = np.empty((len(rest), height + 2, width + 2))
    cells[:] = np.array(rest)[:, np.newaxis, np.newaxis]
    if "start" in inputs:
        given = channels(spec, inputs["start"])[: len(rest)]
        cells[: len(given), 1:-1, 1:-1] = given
    return cells


def noise(spec: DishSpec, use: int) -> NDArray[np.float64]:
    """Return a random number in [-1, 1) for each cell of the dish, (height, width)."""
    width, height = spec.size
    return 2 * uniforms(spec.seed, use, width * height).reshape(height, width) - 1


def fill_rim(cells: Cells, border: str) -> None:
    """Set what lies beyond the edges; a fixed rim stays as it is."""
    if border == "torus":
        cells[:, 0], cells[:, -1] = cells[:, -2], cells[:, 1]
        cells[:, :, 0], cells[:, :, -1] = cells[:, :, -2], cells[:, :, 1]
    elif border == "no_flux":
        cells[:, 0], cells[:, -1] = cells[:, 1], cells[:, -2]
        cells[:, :, 0], cells[:, :, -1] = cells[:, :, 1], cells[:, :, -2]
