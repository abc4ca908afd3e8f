"""Texture optimisation: patches of the target agree on pixels, and pixels on patches.

The engine behind growing, filling and moving. On each level, from coarse to fine, two steps take
turns: every patch of the target looks for its nearest source patch, then every pixel takes the
source pixel most of its patches propose (Kwatra et al., 2005, with the discrete solver of Han et
al., 2006, and random search). A patch that has been used more often than its share becomes
expensive (Kaspar et al., 2015), or smooth places would take over. What copies too much of the
exemplar in one line is barred from doing so. Pixels that are fixed never change, but their
neighbours have to fit to them.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from scipy import ndimage

from worker.synthesis.by_example.block_fitting import fitting_blocks
from worker.synthesis.by_example.long_copies import bar, late
from worker.synthesis.by_example.patch_grid import PatchGrid
from worker.synthesis.by_example.patch_match import (
    NEVER,
    NONE_BARRED,
    Field,
    Patches,
    evaluate,
    improve,
    lines,
)
from worker.synthesis.by_example.pyramid import doubled
from worker.synthesis.by_example.starting import brought_to, continued_outwards, random_blocks
from worker.synthesis.by_example.task import PATCH_SIDE, levels
from worker.synthesis.by_example.voting import vote
from worker.synthesis.by_example.windows import fitting_side, whole_windows

if TYPE_CHECKING:
    from collections.abc import Callable

    from numpy.typing import NDArray

    from worker.stages import Report
    from worker.synthesis.by_example.task import Level, Task

    Bytes = NDArray[np.uint8]
    Mask = NDArray[np.bool_]
    Integers = NDArray[np.int32]

_ROUNDS = (16, 10, 4, 2)
_RADII = (65536, 65536, 32, 8)
_STARTS = 8  # half of them where that is more pixels than
_STARTED = 2**15
_HALVED_AT = (2, 4)  # rounds before which the worse half of them is given up
_DENSE_BELOW = 160
_BAND_ROWS = 64  # searched side by side: few, as coarse levels are small
_PRESSURE = 0.1
_NOWHERE = -(2**20)
_BLOCK = 0.42  # of the exemplar's sides: as large as can be without being copied too long
_ROOM = 1.1  # on the coarsest level, where a patch is nearly as large as a block
_CUT = 0.95
_MENDING = 12  # rounds at most, after the last of the finest level


def optimise(
    task: Task, report: Report, show: Callable[[float, Integers], None] | None = None
) -> Integers:
    """Return the row and column of the source pixel for every target pixel, (height, width, 2).

    Where pixels are fixed it is -1.

    Args:
        task: What is to be made of what.
        report: Told how far it is.
        show: Given how far it is, and what has been found on each level, in the same way; on coarse
            ones for less pixels.
    """
    steps = levels(task)
    work = [_rounds(level) * level.fixed.size for level in steps]
    state = _begun(task, steps[0], finest=len(steps) == 1)
    for level in steps:
        name = f"level {level.depth + 1} of {len(steps)}"
        if level.depth:
            state = _Search(task, level, finest=level is steps[-1]).refining(state)
        rounds = _rounds(level)
        for turn in range(level.depth == 0, rounds + _MENDING):
            if turn >= rounds and not (level is steps[-1] and state.bars_long_copies()):
                break
            done = sum(work[: level.depth]) + min(turn, rounds) * level.fixed.size
            report(done / sum(work), name)
            state.advance(turn)
        if show is not None:
            limits = np.array(task.usable.shape, np.int32) - 1
            so_far = np.minimum(state.place * 2 ** (len(steps) - 1 - level.depth), limits)
            so_far[level.fixed] = -1
            show(sum(work[: level.depth + 1]) / sum(work), so_far)
    state.place[steps[-1].fixed] = -1
    return state.place


def _rounds(level: Level) -> int:
    return _ROUNDS[min(level.depth, len(_ROUNDS) - 1)]


def _begun(task: Task, level: Level, *, finest: bool) -> _Search:
    """Begin with what is given, or several times by chance, and go on with what fits best."""
    if task.start is not None:
        return _Search(task, level, finest=finest).following(task.start)
    count = min(_STARTS, max(_STARTS // 2, _STARTED // level.fixed.size))
    found = [_Search(task, level, finest=finest).beginning(use) for use in range(count)]
    for turn in range(_rounds(level) // 2):
        if turn in _HALVED_AT:
            found = sorted(found, key=lambda state: state.cost)[: len(found) // 2]
        for state in found:
            state.advance(turn)
    return min(found, key=lambda state: state.cost)


class _Search:
    """One level under way."""

    def __init__(self, task: Task, level: Level, *, finest: bool) -> None:
        height, width = level.fixed.shape
        side = fitting_side(level.usable, (height, width), PATCH_SIDE)
        begins = level.depth == 0 and not finest
        stride = 1 if begins or min(height, width) < _DENSE_BELOW or side < 5 else 2
        self._task, self._level, self._finest = task, level, finest
        self._grid = PatchGrid((height, width), side, stride, task.tileable)
        self._covers = self._grid.cover(0), self._grid.cover(1)
        self._allowed = whole_windows(level.usable, (side, side))
        self._voted = np.ascontiguousarray(level.source[..., : task.source.shape[2]])
        self._needed = self._grid.holding(~level.fixed)
        self._used: NDArray[np.float32] = np.zeros(self._allowed.shape, np.float32)
        self._price = 0.0
        self._features = level.target.copy()
        self._barred = np.full((*self._grid.counts, 2), _NOWHERE, np.int32)
        self.place = np.zeros((height, width, 2), np.int32)

    def beginning(self, use: int) -> _Search:
        """Begin with blocks, or, where pixels are fixed, with what continues them."""
        grid, seed, source = self._grid, self._task.seed, self._level.source
        height, width = self._level.usable.shape
        if self._level.fixed.any() or self._task.guides is not None:
            limits = (self._allowed.shape[0], self._allowed.shape[1])
            blocks = random_blocks(grid, limits, max(grid.side, min(height, width) // 2), seed, use)
        else:
            tall, wide = self._smallest()
            size = (max(grid.side, int(_BLOCK * tall)), max(grid.side, int(_BLOCK * wide)))
            blocks = fitting_blocks(grid, source, self._allowed, size, seed, use)
        self._field = Field.of(*self._onto_allowed(*blocks))
        self._active = self._needed
        if self._level.fixed.any():
            voted = self._voted.shape[2]
            known = self._features[..., :voted]
            self._features[..., :voted] = continued_outwards(known, self._level.fixed)
        else:
            self._vote()
        return self

    def following(self, start: Integers) -> _Search:
        """Begin with a map that is nearly right."""
        source = self._level.usable.shape
        rows, columns = brought_to(start, self._task.usable.shape, source, self._grid)
        self._field = Field.of(*self._onto_allowed(rows, columns))
        self._active = np.ones(self._grid.counts, bool)
        self._vote()
        return self

    def refining(self, coarser: _Search) -> _Search:
        """Begin with what was found at half the size."""
        rows, columns = (
            np.arange(count, dtype=np.int64) * self._grid.stride for count in self._grid.counts
        )
        known = coarser._grid.stride
        field = doubled(np.stack(coarser._field[:2]), rows, columns, known)
        self._field = Field.of(*self._onto_allowed(field[0], field[1]))
        barred = doubled(np.moveaxis(coarser._barred, -1, 0), rows, columns, known)
        self._barred = np.ascontiguousarray(np.moveaxis(barred, 0, -1))
        self._active = np.ones(self._grid.counts, bool)
        self._vote()
        return self

    @property
    def cost(self) -> float:
        """The mean cost of a patch."""
        costs = self._field.costs[self._needed]
        return float(costs.mean()) if costs.size else 0.0

    def advance(self, turn: int) -> None:
        """Let patches look twice for better source patches, then pixels choose anew."""
        if self._level.depth == 0:
            self.bars_long_copies(1.0 if self._finest else _ROOM)
        patches = self._patches()
        if turn == 0:
            evaluate(patches, self._field, self._needed)
            costs = self._field.costs[self._needed]
            least = 4.0 * self._grid.side**2 * self._features.shape[2]
            self._price = least + (float(np.median(costs)) if costs.size else 0.0)
        self._used = np.float32(0.5) * (self._used + self._use())
        patches = patches._replace(penalties=self._penalties())
        evaluate(patches, self._field, self._active)
        for half in range(2):
            improve(
                patches,
                self._field,
                self._active,
                iteration=2 * turn + half,
                seed=(self._task.seed + self._level.depth * 0x9E3779B9) % 2**32,
                radius=_RADII[min(self._level.depth, len(_RADII) - 1)],
                band_rows=_BAND_ROWS,
            )
        self._vote()

    def _vote(self) -> None:
        """Let pixels choose; patches that see a change or break off beside a neighbour go on."""
        changed = vote(
            self._voted,
            self._field,
            self._covers,
            self._features,
            self.place,
            self._level.fixed,
            self._active,
        )
        broken = self._grid.breaks(self._field.rows, self._field.columns)
        self._active = self._needed & (self._grid.holding(changed) | broken)

    def bars_long_copies(self, room: float = 1.0) -> bool:
        """Let patches not use what they copy too much of in one line; return if there are any.

        Lines that are too long are made a little shorter than they may be, or they would soon be
        too long again.

        Args:
            room: How long lines may become, as a multiple of the longest that is wished.
        """
        if self._task.longest_copy is None:
            return False
        share = self._task.longest_copy * room
        shape, wraps = self._smallest(), self._task.tileable
        for cut in (1.0, _CUT):
            down, across = (int(share * cut * length) for length in shape)
            if min(down, across) <= self._grid.side:
                return False
            spoilt = late(self.place, (down, across), wraps=wraps)
            if not spoilt.any():
                return False
        found = bar(spoilt, self.place, self._field, self._covers, self._barred)
        self._active |= found
        return bool(found.any())

    def _patches(self) -> Patches:
        return Patches(
            lines(self._grid.padded(self._features)),
            lines(self._level.source),
            np.where(self._allowed, 0, NEVER).astype(np.int32),
            self._grid.side,
            self._features.shape[2],
            self._grid.stride,
            NONE_BARRED if self._task.longest_copy is None else self._barred,
        )

    def _smallest(self) -> tuple[float, float]:
        """Return height and width of the smallest exemplar."""
        (height, width), share = self._level.usable.shape, self._task.smallest
        return height * share[0], width * share[1]

    def _use(self) -> NDArray[np.float32]:
        """Return how often each source patch is used, as a multiple of its share."""
        rows, columns = self._field.rows[self._needed], self._field.columns[self._needed]
        shape = self._allowed.shape
        counts = np.bincount(rows * shape[1] + columns, minlength=self._allowed.size)
        around = ndimage.uniform_filter(counts.reshape(shape).astype(np.float32), 5, mode="nearest")
        return np.asarray(around * np.float32(self._allowed.sum() / max(1, len(rows))), np.float32)

    def _penalties(self) -> Integers:
        prices = self._used * np.float32(_PRESSURE * self._task.variety * self._price)
        whole = np.minimum(prices, np.float32(2**28)).astype(np.int32)
        return np.where(self._allowed, whole, np.int32(NEVER))

    def _onto_allowed(
        self, rows: NDArray[np.integer], columns: NDArray[np.integer]
    ) -> tuple[Integers, Integers]:
        """Replace source patches that must not be used by the nearest that may."""
        rows = np.clip(rows, 0, self._allowed.shape[0] - 1)
        columns = np.clip(columns, 0, self._allowed.shape[1] - 1)
        if not self._allowed.all():
            nearest = ndimage.distance_transform_edt(
                ~self._allowed, return_distances=False, return_indices=True
            )
            rows, columns = nearest[:, rows, columns]
        return np.ascontiguousarray(rows, np.int32), np.ascontiguousarray(columns, np.int32)
