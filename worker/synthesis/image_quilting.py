"""Texture sewn together from square patches (Efros and Freeman, 2001).

Squares are laid from the upper left, row by row, each over the edges of those above and to the left
of it. A square is chosen by chance among those of the exemplar that agree with what lies there
already within 10 % of the best; then the two are cut along the path on which they differ least.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from worker.synthesis._counter_hash import uniforms
from worker.synthesis.by_example.exemplar import Exemplar
from worker.synthesis.by_example.placing import Placing, Squares
from worker.synthesis.by_example.result import finished
from worker.synthesis.by_example.views import Views, square

if TYPE_CHECKING:
    from collections.abc import Mapping

    from numpy.typing import NDArray

    from api_schemas.textures.image_quilting import ImageQuiltingSpec
    from worker.images.image import Image
    from worker.outcome import Outcome
    from worker.stages import Report

    Integers = NDArray[np.int64]


def synthesize(
    spec: ImageQuiltingSpec, size: tuple[int, int], inputs: Mapping[str, Image], report: Report
) -> Outcome:
    """Sew `spec.size` pixels and bring them to (width, height).

    Raises:
        RenderError: No pixel of the exemplar may be copied.
    """
    exemplar = Exemplar.of(inputs)
    views = Views.of(exemplar, turns=spec.turns, flips=spec.flips)
    width, height = spec.size
    spots = quilted(exemplar, views, (height, width), spec, report)
    place, turns = views.sources(spots), spots[..., 0]
    return finished(place, exemplar, inputs, size, turns=turns, normal_range=spec.normal_range)


def quilted(
    exemplar: Exemplar,
    views: Views,
    size: tuple[int, int],
    spec: ImageQuiltingSpec,
    report: Report,
) -> Integers:
    """Return the spot of the views that each pixel is from, (height, width, 3)."""
    squares = Squares.of(spec, exemplar.usable, spec.block)
    side, overlap, step = squares.side, squares.overlap, squares.step
    counts = [max(0, -(-(length - overlap) // step)) or 1 for length in size]
    canvas = [(count - 1) * step + side for count in counts]
    spots = np.zeros((*canvas, 3), np.int64)
    spots[..., 0] = views.names[0]
    placing = Placing(views, side)
    chances = uniforms(spec.seed, 0, counts[0] * counts[1]).reshape(counts)
    for row in range(counts[0]):
        report(row / counts[0], "sewing")
        for column in range(counts[1]):
            there = np.s_[row * step : row * step + side, column * step : column * step + side]
            over = np.zeros((side, side), bool)
            over[:overlap] |= row > 0
            over[:, :overlap] |= column > 0
            old = views.colours(spots[there])
            new = square(placing.chosen(old, over, spec.tolerance, chances[row, column]), side)
            differences = ((old - views.colours(new)) ** 2).sum(axis=-1)
            fresh = np.ones((side, side), bool)
            if column > 0 and overlap > 0:
                fresh &= np.arange(side) >= cut(differences[:, :overlap])[:, np.newaxis]
            if row > 0 and overlap > 0:
                fresh &= np.arange(side)[:, np.newaxis] >= cut(differences[:overlap].T)
            spots[there] = np.where(fresh[..., np.newaxis], new, spots[there])
    return spots[: size[0], : size[1]]


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
