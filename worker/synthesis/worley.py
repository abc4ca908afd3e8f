"""Distances to the nearest of scattered points (Worley, 1996).

The tile is frequency x frequency square cells. Points lie one in each cell or, as a Poisson process
of density 1, as many as chance puts there; a tile always has at least one. Distances are counted in
cells. The search is exact: rings of cells around the pixel are looked at until the next ring cannot
hold a nearer point. Cells and points beyond the tile are those of its copies, and a pixel's place
within its cell is a fraction of whole numbers, so the tile repeats bit for bit.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from api_schemas.textures.worley import WorleySpec
from worker.images.image import Image
from worker.numba_kernel import kernel, parallel_kernel, prange
from worker.stages import silent
from worker.synthesis._counter_hash import uniforms

if TYPE_CHECKING:
    from collections.abc import Mapping

    from numpy.typing import NDArray

    from worker.stages import Report

_METRICS = {"euclidean": 0, "manhattan": 1, "chebyshev": 2}
_OUTPUTS = {"f1": 0, "f2": 1, "difference": 2}
# Shares of a Poisson process of density 1 with at most 0, 1, 2, .. points in a cell
_POISSON = np.exp(-1) * np.cumsum(1 / np.cumprod([1.0, *range(1, 17)]))


class Points(NamedTuple):
    """Points by cell: those of cell c are starts[c] to starts[c + 1], places within it in 0..1.

    Cell (i, j), counted from the lower left corner, is c = j * frequency + i.
    """

    starts: NDArray[np.int64]
    places: NDArray[np.float64]


def synthesize(
    spec: WorleySpec, size: tuple[int, int], inputs: Mapping[str, Image], report: Report
) -> Image:
    """Measure distances at the pixel centres of (width, height): one channel of data, in cells."""
    width, height = size
    values = distances(spec, np.arange(width), width, np.arange(height)[::-1], height)
    return Image(values[..., np.newaxis], spec.meaning)


def distances(
    spec: WorleySpec,
    columns: NDArray[np.int64],
    width: int,
    rows: NDArray[np.int64],
    height: int,
) -> NDArray[np.float32]:
    """Return distances where given columns and rows, counted from the lower left corner, cross.

    Columns and rows beyond `width` and `height` go on into the tile's copies.
    """
    values = np.empty((len(rows), len(columns)), np.float32)
    _fill_distances(
        values,
        *np.divmod((2 * columns + 1) * spec.frequency, 2 * width),
        width,
        *np.divmod((2 * rows + 1) * spec.frequency, 2 * height),
        height,
        scatter(spec),
        spec.frequency,
        _METRICS[spec.metric],
        _OUTPUTS[spec.output],
    )
    return values


def scatter(spec: WorleySpec) -> Points:
    """Scatter the points of a tile."""
    cells = spec.frequency**2
    counts = np.ones(cells, np.int64)
    if spec.points == "poisson":
        counts = np.searchsorted(_POISSON, uniforms(spec.seed, 0, cells), side="right")
        counts[0] += counts.sum() == 0
    starts = np.concatenate([[0], np.cumsum(counts)])
    places = np.stack([uniforms(spec.seed, use, starts[-1]) for use in (1, 2)], axis=-1)
    if spec.points == "one":
        places = 0.5 + spec.jitter * (places - 0.5)
    return Points(starts, places)


def warm() -> None:
    """Compile the kernel."""
    synthesize(WorleySpec(technique="worley", frequency=1), (2, 2), {}, silent)


@parallel_kernel
def _fill_distances(
    values: NDArray[np.float32],
    cells_u: NDArray[np.int64],
    offsets_u: NDArray[np.int64],
    width: int,
    cells_v: NDArray[np.int64],
    offsets_v: NDArray[np.int64],
    height: int,
    points: Points,
    period: int,
    metric: int,
    output: int,
) -> None:
    for row in prange(len(cells_v)):
        y = offsets_v[row] / (2 * height)
        for column in range(len(cells_u)):
            x = offsets_u[column] / (2 * width)
            first, second = _nearest(points, cells_u[column], cells_v[row], x, y, period, metric)
            if metric == 0:
                first, second = np.sqrt(first), np.sqrt(second)
            values[row, column] = (first, second, second - first)[output]


@kernel
def _nearest(
    points: Points, cell_u: int, cell_v: int, x: float, y: float, period: int, metric: int
) -> tuple[float, float]:
    """Return the two smallest distances, squared if euclidean, from (x, y) within a cell."""
    first = second = np.inf
    margin = min(x, 1 - x, y, 1 - y)
    ring = 0
    while True:
        reach = ring - 1 + margin
        if ring > 0 and second <= (reach * reach if metric == 0 else reach):
            return first, second
        for j in range(-ring, ring + 1):
            # Rows within the ring have cells at their two ends only
            step = 1 if abs(j) == ring else 2 * ring
            for i in range(-ring, ring + 1, max(step, 1)):
                cell = (cell_v + j) % period * period + (cell_u + i) % period
                for point in range(points.starts[cell], points.starts[cell + 1]):
                    across = abs(i + points.places[point, 0] - x)
                    up = abs(j + points.places[point, 1] - y)
                    if metric == 0:
                        distance = across * across + up * up
                    elif metric == 1:
                        distance = across + up
                    else:
                        distance = max(across, up)
                    if distance < first:
                        first, second = distance, first
                    elif distance < second:
                        second = distance
        ring += 1
