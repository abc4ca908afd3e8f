"""Texture grown pixel by pixel, each chosen by all that is known around it (Efros, Leung, 1999).

Pixels beside known ones are visited, those with the most known neighbours first. Each is compared
with every place of the exemplar: by the mean squared difference of what is known around it, with
Gaussian weights. Of all places within 10 % of the best one is taken by chance. A pixel whose best
is too bad waits; when all wait, the bound is raised by 10 %. Weights are whole numbers, so that
sums are exact.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from scipy import ndimage

from api_schemas.textures.efros_leung import EfrosLeungSpec
from api_schemas.textures.perlin import PerlinSpec
from worker.images.image import Image
from worker.numba_kernel import kernel
from worker.stages import silent
from worker.synthesis._counter_hash import hashes, uniforms
from worker.synthesis.by_example.clusters import Clusters, visit_clusters
from worker.synthesis.by_example.exemplar import Exemplar
from worker.synthesis.by_example.hashing import below, scrambled
from worker.synthesis.by_example.result import finished
from worker.synthesis.by_example.surroundings import known_around
from worker.synthesis.by_example.windows import middles
from worker.synthesis.by_example.wishes import Wishes

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from numpy.typing import NDArray

    from worker.outcome import Outcome
    from worker.stages import Report
    from worker.synthesis.by_example.arrays import Bytes, Integers, Mask


_SEED_SIDE = 3
_FIRST_BOUND = 0.3
_WEIGHTS_IN_ALL = 8192
"""With four channels of 8 bits, a difference stays below 2^31."""


def synthesize(
    spec: EfrosLeungSpec, size: tuple[int, int], inputs: Mapping[str, Image], report: Report
) -> Outcome:
    """Grow `spec.size` pixels and bring them to (width, height).

    An exemplar too small for the window is compared with a smaller one.

    Raises:
        RenderError: No pixel of the exemplar may be copied.
    """
    exemplar = Exemplar.of(inputs)
    wishes = Wishes.of(spec, exemplar, inputs)
    reach, allowed = _fitting(exemplar.usable, spec.window // 2 - (spec.window % 2 == 0))
    target = np.zeros((*wishes.fixed.shape, exemplar.features.shape[2]), np.uint8)
    if wishes.keep is not None:
        target = exemplar.matching(wishes.keep)
    place = np.full(wishes.fixed.shape, -1, np.int32)
    known = wishes.fixed.copy()
    if not known.any():
        _sow(place, known, target, exemplar, spec.seed)
    _grow(place, known, target, exemplar, allowed, reach, spec, report)
    rows, columns = np.divmod(place, np.int32(exemplar.shape[1]))
    found = np.stack([rows, columns], axis=-1)
    found[wishes.fixed] = -1
    return finished(found, exemplar, inputs, size, wishes.keep)


def warm() -> None:
    """Compile the kernels."""
    picture = Image(np.linspace(0, 1, 147, dtype=np.float32).reshape(7, 7, 3), "colour")
    for clusters in (0, 2):
        spec = EfrosLeungSpec(
            technique="efros_leung",
            exemplar=PerlinSpec(technique="perlin"),
            size=[5, 5],
            window=3,
            clusters=clusters,
        )
        synthesize(spec, (5, 5), {"exemplar": picture}, silent)


def _fitting(usable: Mask, reach: int) -> tuple[int, Mask]:
    """Return the largest reach whose window fits somewhere, and the middles of where."""
    while True:
        allowed = middles(usable, (2 * reach + 1, 2 * reach + 1))
        if allowed.any():
            return reach, allowed
        reach -= 1


def _sow(place: Integers, known: Mask, target: Bytes, exemplar: Exemplar, seed: int) -> None:
    """Copy a small square from a random place into the middle."""
    side = min(_SEED_SIDE, *known.shape, *exemplar.shape)
    while not (starts := np.flatnonzero(middles(exemplar.usable, (side, side)))).size:
        side -= 1
    chosen = starts[int(uniforms(seed, 0, 1)[0] * len(starts))]
    row, column = divmod(int(chosen), exemplar.shape[1])
    rows = row - side // 2 + np.arange(side)[:, np.newaxis]
    columns = column - side // 2 + np.arange(side)
    top, left = ((length - side) // 2 for length in known.shape)
    middle = np.s_[top : top + side, left : left + side]
    place[middle] = rows * exemplar.shape[1] + columns
    target[middle] = exemplar.features[rows, columns]
    known[middle] = True


def _grow(
    place: Integers,
    known: Mask,
    target: Bytes,
    exemplar: Exemplar,
    allowed: Mask,
    reach: int,
    spec: EfrosLeungSpec,
    report: Report,
) -> None:
    """Fill all that is not known, from the outside of what is."""
    visit = _visitor(place, known, target, exemplar, allowed, reach, spec)
    mode = "wrap" if spec.tileable else "constant"
    ring = np.ones((3, 3), bool)
    chances = uniforms(spec.seed, 1, known.size).reshape(known.shape)
    bound, turn = _FIRST_BOUND, 0
    while not known.all():
        report(float(known.mean()), "growing outwards")
        counts = ndimage.uniform_filter(known.astype(np.float64), 2 * reach + 1, mode=mode)
        near = ndimage.maximum_filter(known, footprint=ring, mode=mode) & ~known
        pixels = np.flatnonzero(near)
        order = np.lexsort(
            (chances.flat[pixels], -np.rint(counts.flat[pixels] * (2 * reach + 1) ** 2))
        )
        key = hashes(spec.seed, 2 + turn, 1)[0]
        turn += 1
        if not visit(pixels[order], bound, key):
            bound *= 1.1


def _visitor(
    place: Integers,
    known: Mask,
    target: Bytes,
    exemplar: Exemplar,
    allowed: Mask,
    reach: int,
    spec: EfrosLeungSpec,
) -> Callable[[NDArray[np.int64], float, np.uint64], int]:
    """Return what chooses pixels within a bound, by a random key; it tells how many it could."""
    weights = _weights(reach)
    if spec.clusters:
        features = exemplar.features
        clusters = Clusters.of(features, allowed, reach, spec.clusters, spec.seed)

        def visit(pixels: NDArray[np.int64], bound: float, key: np.uint64) -> int:
            return visit_clusters(
                pixels, place, known, target, features, clusters, weights, bound, spec.tileable, key
            )

        return visit
    planes = np.ascontiguousarray(np.moveaxis(exemplar.features, -1, 0))

    def visit_all(pixels: NDArray[np.int64], bound: float, key: np.uint64) -> int:
        return _visit(
            pixels, place, known, target, planes, allowed, weights, bound, spec.tileable, key
        )

    return visit_all


def _weights(reach: int) -> Integers:
    """Return whole Gaussian weights, (window, window), of a width of window / 6.4."""
    steps = np.arange(-reach, reach + 1)
    line = np.exp(-0.5 * (steps / ((2 * reach + 1) / 6.4)) ** 2)
    weights = np.outer(line, line)
    return np.asarray(np.rint(weights * (_WEIGHTS_IN_ALL / weights.sum())), np.int32)


@kernel
def _visit(
    pixels: NDArray[np.int64],
    place: Integers,
    known: Mask,
    target: Bytes,
    planes: Bytes,
    allowed: Mask,
    weights: Integers,
    bound: float,
    wraps: bool,
    key: np.uint64,
) -> int:
    """Choose pixels one after the other; return how many of them found something good enough."""
    width = known.shape[1]
    lower, wide = allowed.shape
    channels = len(planes)
    reach = len(weights) // 2
    first, last = reach, lower - reach
    differences = np.empty((lower, wide), np.int32)
    placed = 0
    for pixel in pixels:
        y, x = pixel // width, pixel % width
        differences[first:last] = 0
        steps, near, values = known_around(known, target, weights, (y, x), wraps)
        total = near.sum()
        for i in range(len(near)):
            down, right = steps[i]
            for channel in range(channels):
                for v in range(first, last):
                    _add(
                        differences[v, reach : wide - reach],
                        planes[channel, v + down, reach + right : wide - reach + right],
                        np.int32(values[i, channel]),
                        np.int32(near[i]),
                    )
        least = np.int64(2**31)
        for v in range(first, last):
            for u in range(reach, wide - reach):
                if allowed[v, u] and differences[v, u] < least:
                    least = np.int64(differences[v, u])
        # Beside known pixels only whose weight is nothing, any place is as good
        if total > 0 and least > bound * (65025.0 * channels) * total:
            continue
        limit = np.int64(np.floor(least * 1.1))
        count = 0
        for v in range(first, last):
            for u in range(reach, wide - reach):
                count += allowed[v, u] and differences[v, u] <= limit
        chosen = below(scrambled(key, pixel), count)
        for v in range(first, last):
            for u in range(reach, wide - reach):
                if allowed[v, u] and differences[v, u] <= limit:
                    if chosen == 0:
                        place[y, x] = v * wide + u
                        for channel in range(channels):
                            target[y, x, channel] = planes[channel, v, u]
                    chosen -= 1
        known[y, x] = True
        placed += 1
    return placed


@kernel
def _add(differences: Integers, line: Bytes, value: np.int32, weight: np.int32) -> None:
    for i in range(len(differences)):
        step = np.int32(line[i]) - value
        differences[i] += weight * (step * step)
