"""Square tiles cut from an exemplar that fit wherever their corners are of the same kinds.

Each kind of corner is a square of the exemplar. Where two kinds follow each other, a band along the
edge between them is another square, sewn to both corners; the middle of each tile is one more, sewn
to its four edges. So tiles that meet show halves of the same corners and bands, and nowhere do
pieces meet that were not sewn together (Lagae and Dutre, 2006, colour corners for that reason).
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from worker.synthesis._counter_hash import uniforms
from worker.synthesis.by_example.placing import NEVER, Placing
from worker.synthesis.by_example.sewing import Seams, sewn
from worker.synthesis.by_example.uses import Uses
from worker.synthesis.by_example.views import Views, square

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from worker.synthesis.by_example.exemplar import Exemplar

    Mask = NDArray[np.bool_]
    Integers = NDArray[np.int64]

TRIES = 3
_EVENNESS, _CHANCE = 0.5, 0.1
"""Shares of the best square's difference: how much worse one is taken to be whose pixels have been
used as often as all are on average, and how much chance makes of it."""


class Corners(NamedTuple):
    """The kinds of a tile's corners, from 0 on."""

    upper_left: int
    upper_right: int
    lower_right: int
    lower_left: int


class TileSet:
    """Corners of some kinds, the edges between them, and the tiles that are asked for."""

    def __init__(self, exemplar: Exemplar, side: int, kinds: int, seed: int) -> None:
        """Cut all corners and edges of tiles of `side` pixels, an even number from 4 on."""
        self._side, self._depth = side, side // 4
        self._squares = _Squares(exemplar, side, seed)
        near = self._to_middle < self._depth
        self._corners = [self._squares.laid(self._nothing, near & near.T) for _ in range(kinds)]
        pairs = list(np.ndindex(kinds, kinds))
        self._across = {pair: self._edge(*pair, upright=False) for pair in pairs}
        self._upright = {pair: self._edge(*pair, upright=True) for pair in pairs}

    def tile(self, corners: Corners) -> Integers:
        """Return the spots of a new tile, (side, side, 3)."""
        upper_left, upper_right, lower_right, lower_left = corners
        across = _between(
            self._across[upper_left, upper_right], self._across[lower_left, lower_right], 0
        )
        upright = _between(
            self._upright[upper_left, lower_left], self._upright[upper_right, lower_right], 1
        )
        rows, columns = self._to_end, self._to_end.T
        nearest = np.minimum(rows, columns)[..., np.newaxis]
        # Where both edges are as near, both show the corner
        frame = np.where((rows < columns)[..., np.newaxis], across, upright)
        frame = np.where(nearest < self._depth, frame, self._nothing)
        return self._squares.laid(frame, nearest[..., 0] > 0)

    def _edge(self, first: int, last: int, *, upright: bool) -> Integers:
        """Return the spots of a square on whose middle line an edge lies, -1 where none is known.

        It changes corners only where they are nearer to this edge than to those that cross it.
        """
        corners = _between(self._corners[first], self._corners[last], 0 if upright else 1)
        away, end = self._to_middle, self._to_end.T
        if upright:
            away, end = away.T, end.T
        known = (away < self._depth) & (end < self._depth)
        old = np.where(known[..., np.newaxis], corners, self._nothing)
        return self._squares.laid(old, (away < self._depth) & (away < end))

    @property
    def _nothing(self) -> Integers:
        return np.full((self._side, self._side, 3), -1, np.int64)

    @property
    def _to_end(self) -> Integers:
        """Whole pixels to the upper or lower end, (side, side)."""
        steps = np.arange(self._side)
        return np.repeat(np.minimum(steps, steps[::-1])[:, np.newaxis], self._side, axis=1)

    @property
    def _to_middle(self) -> Integers:
        """Whole pixels to the line between the upper and the lower half, (side, side)."""
        return self._side // 2 - 1 - self._to_end


class _Squares:
    """Squares of an exemplar, each laid where others are already.

    Of squares that agree with these, those are preferred whose pixels have been used least, and of
    some the one is taken whose seams are seen least.
    """

    def __init__(self, exemplar: Exemplar, side: int, seed: int) -> None:
        self._views = Views.of(exemplar, turns=False, flips=False)
        self._placing, self._uses = Placing(self._views, side), Uses(exemplar.shape)
        self._side, self._seed, self._count = side, seed, 0
        self._seams = Seams.of(self._views, side)

    def laid(self, old: Integers, free: Mask) -> Integers:
        """Return spots, (side, side, 3), sewn to those of a square that may be seen where free."""
        known = old[..., 0] >= 0
        scores = self._scores(old, known)
        made: list[tuple[int, Integers]] = []
        # Where nothing is known all squares are sewn alike
        for _ in range(TRIES if known.any() else 1):
            row, column = (int(k) for k in np.unravel_index(scores.argmin(), scores.shape))
            if made and np.isinf(scores[row, column]):
                break
            spots = sewn(self._seams, old, square((0, row, column), self._side), free)
            cost = int(self._seams.all_seen(spots, spots[..., 0] >= 0).sum())
            made.append((cost, spots))
            near = self._side // 4
            scores[max(0, row - near) : row + near, max(0, column - near) : column + near] = np.inf
        best = min(made, key=lambda costs_and_spots: costs_and_spots[0])[1]
        fresh = best[(best != old).any(axis=-1)]
        self._uses.count(fresh[:, 1], fresh[:, 2])
        return best

    def _scores(self, old: Integers, known: Mask) -> NDArray[np.float64]:
        """Return how badly each square, by its upper left pixel, suits what is known."""
        colours = self._views.colours(np.where(known[..., np.newaxis], old, 0))
        (costs,) = self._placing.costs(colours, known)
        allowed = costs < NEVER
        chance = uniforms(self._seed, self._count, costs.size).reshape(costs.shape)
        self._count += 1
        scale = int(costs.min()) if known.any() else 1
        uses = self._uses.of_windows((self._side, self._side))
        scores = costs + scale * (_EVENNESS * uses + _CHANCE * chance)
        return np.where(allowed, scores, np.inf)


def _between(first: Integers, last: Integers, axis: int) -> Integers:
    """Return the square half of which is the end of one and half the beginning of another."""
    return np.concatenate([np.split(first, 2, axis)[1], np.split(last, 2, axis)[0]], axis=axis)
