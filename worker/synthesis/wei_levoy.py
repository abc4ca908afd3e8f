"""Texture grown in scan order from coarse to fine (Wei and Levoy, 2000).

Each pixel gets the exemplar's pixel whose neighbourhood is nearest of all: what lies above and to
the left on its own level, and the square around it on the next coarser one. The search is exact:
pixels that do not see each other are compared with all of the exemplar in one matrix product, of
whole numbers that float32 holds exactly (see `by_example.exact`). The picture goes on around its
edges. Across them a pixel sees what was there before, noise at first; so pixels near the edges are
chosen once more, by all that is around them.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from worker.synthesis._counter_hash import hashes
from worker.synthesis.by_example.exemplar import Exemplar
from worker.synthesis.by_example.pyramid import halved
from worker.synthesis.by_example.result import finished
from worker.synthesis.by_example.windows import middles

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from numpy.typing import NDArray

    from api_schemas.textures.wei_levoy import WeiLevoySpec
    from worker.images.image import Image
    from worker.outcome import Outcome
    from worker.stages import Report
    from worker.synthesis.by_example.arrays import Bytes, Mask

    Indices = NDArray[np.int64]

_COARSE_REACH = 2
_LEAST_SIDE = 8


class _Level(NamedTuple):
    source: Bytes
    usable: Mask
    size: tuple[int, int]


def synthesize(
    spec: WeiLevoySpec, size: tuple[int, int], inputs: Mapping[str, Image], report: Report
) -> Outcome:
    """Grow `spec.size` pixels and bring them to (width, height).

    Levels too small to be of use are left out; an exemplar too small for the neighbourhood is
    compared with a smaller one.

    Raises:
        RenderError: No pixel of the exemplar may be copied.
    """
    exemplar = Exemplar.of(inputs)
    width, height = spec.size
    levels = _levels(exemplar, (height, width), spec.levels)
    work = np.cumsum([level.size[0] * level.size[1] * level.usable.size for level in levels])
    coarser: Bytes | None = None
    for depth, level in enumerate(levels):
        before = 0 if depth == 0 else work[depth - 1]

        def told(share: float, before: int = before, depth: int = depth) -> None:
            done = before + share * (work[depth] - before)
            report(float(done / work[-1]), f"level {depth + 1} of {len(levels)}")

        below = None if coarser is None else (levels[depth - 1].source, coarser)
        place = _grown(level, below, spec, depth, told)
        coarser = level.source.reshape(-1, level.source.shape[2])[place]
    rows, columns = np.divmod(place, exemplar.shape[1])
    found = np.stack([rows, columns], axis=-1).astype(np.int32)
    return finished(found, exemplar, inputs, size)


def _levels(exemplar: Exemplar, size: tuple[int, int], count: int) -> list[_Level]:
    """Return the exemplar and the result's size from coarse to fine."""
    found = [_Level(exemplar.features, exemplar.usable, size)]
    while len(found) < count:
        source, usable, (height, width) = found[-1]
        if min(*usable.shape, height, width) < 2 * _LEAST_SIDE:
            break
        source, usable = halved(source, usable)
        if not usable.any():
            break
        found.append(_Level(source, usable, (height // 2, width // 2)))
    return found[::-1]


def _grown(
    level: _Level,
    coarser: tuple[Bytes, Bytes] | None,
    spec: WeiLevoySpec,
    depth: int,
    told: Callable[[float], None],
) -> Indices:
    """Return the source pixel, numbered row by row, for each pixel of a level."""
    height, width = level.size
    reach, places = _fitting(level.usable, spec.neighbourhood)
    chance = hashes(spec.seed, depth, height * width) >> np.uint64(32)
    start = ((chance * np.uint64(len(places))) >> np.uint64(32)).astype(np.int64)
    chosen = start.reshape(height, width)
    square = np.array(
        [(y, x) for y in range(-reach, reach + 1) for x in range(-reach, reach + 1) if y or x],
        np.int64,
    ).reshape(-1, 2)
    everywhere = np.ones(level.size, bool)
    edges = everywhere.copy()
    edges[2 * reach : height - 2 * reach, 2 * reach : width - 2 * reach] = False
    for offsets, mask, begin, end in (
        (square[: len(square) // 2], everywhere, 0.0, 0.8),
        (square, edges, 0.8, 1.0),
    ):
        search = _Search(level, coarser, places, offsets)
        waves = width + (reach + 1) * (height - 1)
        for wave in range(waves):
            if wave % 16 == 0:
                told(begin + (end - begin) * wave / waves)
            first = max(0, -(-(wave - width + 1) // (reach + 1)))
            rows = np.arange(first, min(height - 1, wave // (reach + 1)) + 1)
            pixels = np.stack([rows, wave - (reach + 1) * rows], axis=-1)
            pixels = pixels[mask[pixels[:, 0], pixels[:, 1]]]
            if len(pixels):
                chosen[pixels[:, 0], pixels[:, 1]] = search.nearest(chosen, pixels)
    return np.asarray(places[chosen] @ np.array([level.usable.shape[1], 1]), np.int64)


class _Search:
    """Finds the nearest of all neighbourhoods of a level."""

    def __init__(
        self,
        level: _Level,
        coarser: tuple[Bytes, Bytes] | None,
        places: Indices,
        offsets: Indices,
    ) -> None:
        """Write down the neighbourhoods of all `places`: what lies at `offsets` from them."""
        self._coarser, self._offsets = coarser, offsets
        self._colours = level.source[places[:, 0], places[:, 1]]
        around = places[:, np.newaxis] + offsets
        known = _lines(level.source[around[..., 0], around[..., 1]])
        if coarser is not None:
            parents = np.minimum(places // 2, np.array(coarser[0].shape[:2]) - 1)
            known = np.concatenate([known, _square(coarser[0], parents, wraps=False)], axis=1)
        self._products = np.ascontiguousarray(-2 * known.T)
        self._squares = np.einsum("ij,ij->i", known, known)

    def nearest(self, chosen: Indices, pixels: Indices) -> Indices:
        """Return the number of the place nearest to each pixel, where others are as `chosen`."""
        around = (pixels[:, np.newaxis] + self._offsets) % chosen.shape
        wanted = _lines(self._colours[chosen[around[..., 0], around[..., 1]]])
        if self._coarser is not None:
            parents = np.minimum(pixels // 2, np.array(self._coarser[1].shape[:2]) - 1)
            wanted = np.concatenate(
                [wanted, _square(self._coarser[1], parents, wraps=True)], axis=1
            )
        return np.asarray((wanted @ self._products + self._squares).argmin(axis=1), np.int64)


def _fitting(usable: Mask, reach: int) -> tuple[int, Indices]:
    """Return the largest reach whose neighbourhood fits somewhere, and the pixels where it does."""
    while True:
        whole = middles(usable, (2 * reach + 1, 2 * reach + 1))
        if whole.any():
            return reach, np.argwhere(whole)
        reach -= 1


def _lines(found: Bytes) -> NDArray[np.float32]:
    """Return what was found around each of some pixels as a line of numbers."""
    return np.asarray(found.reshape(len(found), found[0].size), np.float32)


def _square(picture: Bytes, pixels: Indices, *, wraps: bool) -> NDArray[np.float32]:
    """Return the squares around pixels; beyond the edges lie the opposite ones, or the edges."""
    steps = np.arange(-_COARSE_REACH, _COARSE_REACH + 1)
    rows, columns = pixels[:, :1] + steps, pixels[:, 1:] + steps
    height, width = picture.shape[:2]
    if wraps:
        rows, columns = rows % height, columns % width
    else:
        rows, columns = np.clip(rows, 0, height - 1), np.clip(columns, 0, width - 1)
    found = picture[rows[:, :, np.newaxis], columns[:, np.newaxis, :]]
    return _lines(found)
