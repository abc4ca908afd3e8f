"""Distances to the nearest of scattered points, in a plane or in space (Worley, 1996).

The tile is frequency x frequency square cells, or as many cubes. Points lie one in each cell or, as
a Poisson process of density 1, as many as chance puts there; a tile always has at least one.
Distances are counted in cells, and exact. Cells and points beyond the tile are those
of its copies, and a pixel's place within its cell is a fraction of whole numbers, so the tile
repeats bit for bit.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from api_schemas.textures.worley import WorleySpec
from worker.images.image import Image
from worker.images.volume import Volume
from worker.stages import silent
from worker.synthesis._counter_hash import key, uniforms
from worker.synthesis._worley_search import Points, fill_distances, fill_distances_at

if TYPE_CHECKING:
    from collections.abc import Mapping

    from numpy.typing import NDArray

    from worker.closed_form import Parameter
    from worker.stages import Report

METRICS = {"euclidean": 0, "manhattan": 1, "chebyshev": 2}
OUTPUTS = {"f1": 0, "f2": 1, "difference": 2}
POISSON = np.exp(-1) * np.cumsum(1 / np.cumprod([1.0, *range(1, 17)]))
"""Shares of a Poisson process of density 1 with at most 0, 1, 2, .. points in a cell."""


def synthesize(
    spec: WorleySpec, size: tuple[int, int], inputs: Mapping[str, Image], report: Report
) -> Image:
    """Measure distances at the pixel centres of (width, height): one channel of data, in cells."""
    width, height = size
    values = distances(spec, [np.arange(width), np.arange(height)[::-1]], size)
    return Image(values[..., np.newaxis], spec.meaning)


def synthesize_volume(
    spec: WorleySpec, size: tuple[int, int, int], inputs: Mapping[str, Volume], report: Report
) -> Volume:
    """Measure distances at the voxel centres of (width, height, depth): one channel of data."""
    width, height, depth = size
    values = distances(spec, [np.arange(width), np.arange(height)[::-1], np.arange(depth)], size)
    return Volume(values[..., np.newaxis], spec.meaning)


def distances(
    spec: WorleySpec, indices: list[NDArray[np.int64]], counts: tuple[int, ...]
) -> NDArray[np.float32]:
    """Return distances where given pixels of two or three axes cross, the last axis first.

    Args:
        spec: The noise.
        indices: Pixels along u, v and perhaps w, counted from the lower left corner of the first
            slice; what lies beyond the counts goes on into the tile's copies.
        counts: Pixels per tile along each.
    """
    axes = [
        np.divmod((2 * index + 1) * spec.frequency, 2 * count)
        for index, count in zip(indices, counts, strict=True)
    ]
    cells, rests = zip(*axes, strict=True)
    offsets = [rest / (2 * count) for rest, count in zip(rests, counts, strict=True)]
    flat = len(indices) == 2
    values = np.empty([len(index) for index in indices[::-1]], np.float32)
    fill_distances(
        values[np.newaxis] if flat else values,
        (*cells, np.zeros(1, np.int64)) if flat else cells,
        (*offsets, np.zeros(1)) if flat else tuple(offsets),
        scatter(spec, len(indices)),
        spec.frequency,
        flat,
        METRICS[spec.metric],
        OUTPUTS[spec.output],
    )
    return values


def distances_at(spec: WorleySpec, places: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return distances (n,) at points of the plane (n, 2) or of space (n, 3), in tiles."""
    axes = places.shape[1]
    where = np.zeros((len(places), 3))
    where[:, :axes] = places * spec.frequency
    values = np.empty(len(places))
    fill_distances_at(
        values,
        where,
        scatter(spec, axes),
        spec.frequency,
        axes == 2,
        METRICS[spec.metric],
        OUTPUTS[spec.output],
    )
    return values


def closed_form(spec: WorleySpec, *, solid: bool) -> Mapping[str, Parameter]:
    """Return what the points are made from, and how distance is measured."""
    cells = spec.frequency ** (3 if solid else 2)
    poisson = spec.points == "poisson"
    # Of more cells than a few one has a point, so nobody needs to look
    lone = poisson and cells <= 64 and not _chance(spec, cells).any()
    keys = [key(spec.seed, use) for use in range(4)]
    return {
        "frequency": spec.frequency,
        "flat_tile": int(not solid),
        "poisson": int(poisson),
        "lone": int(lone),
        "jitter": spec.jitter,
        "metric": METRICS[spec.metric],
        "shown": OUTPUTS[spec.output],
        "keys": np.array([[k >> 16 * q & 0xFFFF for q in range(4)] for k in keys], np.float32),
    }


def scatter(spec: WorleySpec, axes: int = 2) -> Points:
    """Scatter the points of a tile with two or three axes.

    Point k of cell c has random numbers c + k * cells.
    """
    cells = spec.frequency**axes
    counts = np.ones(cells, np.int64)
    if spec.points == "poisson":
        counts = _chance(spec, cells)
        counts[0] += counts.sum() == 0
    starts = np.concatenate([[0], np.cumsum(counts)])
    places = np.full((starts[-1], 3), 0.5)
    for nth in range(counts.max()):
        holds = counts > nth
        for axis in range(axes):
            numbers = uniforms(spec.seed, 1 + axis, cells, nth * cells)
            places[starts[:-1][holds] + nth, axis] = numbers[holds]
    if spec.points == "one":
        places = 0.5 + spec.jitter * (places - 0.5)
    return Points(starts, places)


def _chance(spec: WorleySpec, cells: int) -> NDArray[np.int64]:
    return np.searchsorted(POISSON, uniforms(spec.seed, 0, cells), side="right")


def warm() -> None:
    """Compile the kernel."""
    synthesize(WorleySpec(technique="worley", frequency=1), (2, 2), {}, silent)
