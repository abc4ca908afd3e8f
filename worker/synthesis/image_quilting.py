"""Texture sewn together from square patches (Efros and Freeman, 2001).

Squares are laid from the upper left, row by row, each over the edges of those above and to the left
of it. A square is chosen by chance among those of the exemplar that agree with what lies there
already within 10 % of the best; then the two are cut along the path on which they differ least.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from api_schemas.textures.image_quilting import ImageQuiltingSpec
from api_schemas.textures.perlin import PerlinSpec
from worker.images.image import Image
from worker.numba_kernel import kernel, parallel_kernel, prange
from worker.stages import silent
from worker.synthesis._counter_hash import uniforms
from worker.synthesis.by_example.exemplar import Exemplar
from worker.synthesis.by_example.result import finished
from worker.synthesis.by_example.windows import fitting_side, whole_windows

if TYPE_CHECKING:
    from collections.abc import Mapping

    from numpy.typing import NDArray

    from worker.outcome import Outcome
    from worker.stages import Report

    Bytes = NDArray[np.uint8]
    Mask = NDArray[np.bool_]
    Integers = NDArray[np.int64]


def synthesize(
    spec: ImageQuiltingSpec, size: tuple[int, int], inputs: Mapping[str, Image], report: Report
) -> Outcome:
    """Sew `spec.size` pixels and bring them to (width, height).

    Raises:
        RenderError: No pixel of the exemplar may be copied.
    """
    exemplar = Exemplar.of(inputs)
    width, height = spec.size
    place = quilted(exemplar, (height, width), spec, report)
    return finished(place.astype(np.int32), exemplar, inputs, size)


def quilted(
    exemplar: Exemplar, size: tuple[int, int], spec: ImageQuiltingSpec, report: Report
) -> Integers:
    """Return row and column of the source of each pixel, (height, width, 2)."""
    side = fitting_side(exemplar.usable, (spec.block, spec.block), spec.block)
    overlap = min(max(1, round(spec.overlap * side)), side // 2)
    step = side - overlap
    counts = [max(0, -(-(length - overlap) // step)) or 1 for length in size]
    canvas = [(count - 1) * step + side for count in counts]
    place = np.zeros((*canvas, 2), np.int64)
    allowed = whole_windows(exemplar.usable, (side, side))
    planes = np.ascontiguousarray(np.moveaxis(exemplar.features, -1, 0))
    chances = uniforms(spec.seed, 0, counts[0] * counts[1]).reshape(counts)
    inner = np.moveaxis(np.indices((side, side)), 0, -1)
    for row in range(counts[0]):
        report(row / counts[0], "sewing")
        for column in range(counts[1]):
            there = np.s_[row * step : row * step + side, column * step : column * step + side]
            over = np.zeros((side, side), bool)
            over[:overlap] |= row > 0
            over[:, :overlap] |= column > 0
            old = exemplar.features[place[there][..., 0], place[there][..., 1]]
            corner = _chosen(planes, allowed, old, over, spec.tolerance, chances[row, column])
            new = inner + corner
            apart = old.astype(np.int64) - exemplar.features[new[..., 0], new[..., 1]]
            differences = (apart**2).sum(axis=-1)
            fresh = np.ones((side, side), bool)
            if column > 0 and overlap > 0:
                fresh &= np.arange(side) >= cut(differences[:, :overlap])[:, np.newaxis]
            if row > 0 and overlap > 0:
                fresh &= np.arange(side)[:, np.newaxis] >= cut(differences[:overlap].T)
            place[there] = np.where(fresh[..., np.newaxis], new, place[there])
    return place[: size[0], : size[1]]


def cut(differences: Integers) -> Integers:
    """Return where along each row a path from top to bottom crosses that differs least in all.

    From row to row it moves by one column at most.

    Args:
        differences: What crossing at a pixel costs, (rows, columns).
    """
    rows, columns = differences.shape
    sums = differences.copy()
    far = np.iinfo(np.int64).max // 2
    for row in range(1, rows):
        before = np.pad(sums[row - 1], 1, constant_values=far)
        sums[row] += np.minimum(np.minimum(before[:-2], before[1:-1]), before[2:])
    path = np.zeros(rows, np.int64)
    path[-1] = sums[-1].argmin()
    for row in range(rows - 2, -1, -1):
        first = max(0, path[row + 1] - 1)
        path[row] = first + sums[row, first : min(columns, path[row + 1] + 2)].argmin()
    return path


def warm() -> None:
    """Compile the kernels."""
    picture = Image(np.linspace(0, 1, 147, dtype=np.float32).reshape(7, 7, 3), "colour")
    spec = ImageQuiltingSpec(
        technique="image_quilting", exemplar=PerlinSpec(technique="perlin"), size=[9, 9], block=4
    )
    synthesize(spec, (9, 9), {"exemplar": picture}, silent)


def _chosen(
    planes: Bytes, allowed: Mask, old: Bytes, over: Mask, tolerance: float, chance: float
) -> Integers:
    """Return the upper left corner of a square of the exemplar, by a chance in [0, 1)."""
    costs = np.zeros(allowed.shape, np.int64)
    rows, columns = np.nonzero(over)
    if len(rows):
        _compare(costs, planes, old[over], rows, columns)
    costs[~allowed] = np.iinfo(np.int64).max
    near = np.flatnonzero(costs <= costs.min() * (1 + tolerance))
    return np.array(np.divmod(near[int(chance * len(near))], allowed.shape[1]))


@parallel_kernel
def _compare(
    costs: Integers, planes: Bytes, wanted: Bytes, rows: Integers, columns: Integers
) -> None:
    """Add up squared differences of some pixels of a square, for each corner in the exemplar."""
    for v in prange(costs.shape[0]):
        sums = np.empty(costs.shape[1], np.int32)
        # Sums of 4096 pixels of four channels stay below 2^31
        for start in range(0, len(rows), 4096):
            sums[:] = 0
            for i in range(start, min(start + 4096, len(rows))):
                for channel in range(len(planes)):
                    line = planes[channel, v + rows[i], columns[i] : columns[i] + len(sums)]
                    _add(sums, line, np.int32(wanted[i, channel]))
            for u in range(len(sums)):
                costs[v, u] += sums[u]


@kernel
def _add(sums: NDArray[np.int32], line: Bytes, value: np.int32) -> None:
    for i in range(len(sums)):
        step = np.int32(line[i]) - value
        sums[i] += step * step
