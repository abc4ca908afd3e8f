"""Texture optimisation: patches of the target agree on pixels, and pixels on patches.

The engine behind growing, filling and moving. On each level, from coarse to fine, two steps take
turns: every patch of the target looks for its nearest source patch, then every pixel takes the
source pixel most of its patches propose (Kwatra et al., 2005, with the discrete solver of Han et
al., 2006, and random search). A patch that has been used more often than its share becomes
expensive (Kaspar et al., 2015), or smooth places would take over. Pixels that are fixed never
change, but their neighbours have to fit to them.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from scipy import ndimage

from worker.synthesis.by_example.long_copies import late
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
from worker.synthesis.by_example.task import levels
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

_ROUNDS = (16, 10, 6, 4)
_RADII = (65536, 65536, 32, 8)
_STARTS = 8
_DENSE_BELOW = 160
_PRESSURE = 0.1
_NOWHERE = -(2**20)


def optimise(
    task: Task, report: Report, show: Callable[[Integers], None] | None = None
) -> Integers:
    """Return the row and column of the source pixel for every target pixel, (height, width, 2).

    Where pixels are fixed it is -1.

    Args:
        task: What is to be made of what.
        report: Told how far it is.
        show: Given what has been found so far, on coarse levels for less pixels.
    """
    steps = levels(task)
    work = [_rounds(level) * level.fixed.size for level in steps]
    state = _begun(task, steps[0], dense=len(steps) > 1)
    for level in steps:
        name = f"level {level.depth + 1} of {len(steps)}"
        if level.depth:
            state = _Search(task, level, dense=level.depth + 1 < len(steps)).refining(state)
        for turn in range(level.depth == 0, _rounds(level)):
            done = sum(work[: level.depth]) + turn * level.fixed.size
            report(done / sum(work), name)
            state.advance(turn)
            if show is not None and not level.fixed.any():
                limits = np.array(task.usable.shape, np.int32) - 1
                show(np.minimum(state.place * 2 ** (len(steps) - 1 - level.depth), limits))
    state.place[steps[-1].fixed] = -1
    return state.place


def _rounds(level: Level) -> int:
    return _ROUNDS[min(level.depth, len(_ROUNDS) - 1)]


def _begun(task: Task, level: Level, *, dense: bool) -> _Search:
    """Begin with what is given, or several times by chance, and go on with what fits best."""
    if task.start is not None:
        return _Search(task, level, dense=dense).following(task.start)
    found = [_Search(task, level, dense=dense).random(use) for use in range(_STARTS)]
    for state in found:
        for turn in range(_rounds(level) // 2):
            state.advance(turn)
    return min(found, key=lambda state: state.cost)


class _Search:
    """One level under way."""

    def __init__(self, task: Task, level: Level, *, dense: bool) -> None:
        height, width = level.fixed.shape
        side = fitting_side(level.usable, (height, width), level.patch_side)
        stride = 1 if dense or min(height, width) < _DENSE_BELOW or side < 5 else 2
        self._task, self._level = task, level
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

    def random(self, use: int) -> _Search:
        """Begin with random blocks, or, where pixels are fixed, with what continues them."""
        side = max(self._grid.side, min(self._level.usable.shape) // 2)
        limits = self._allowed.shape
        blocks = random_blocks(self._grid, (limits[0], limits[1]), side, self._task.seed, use)
        self._field = Field.of(*self._onto_allowed(*blocks))
        self._active = np.ones(self._grid.counts, bool)
        if self._level.fixed.any():
            voted = self._voted.shape[2]
            known = self._features[..., :voted]
            self._features[..., :voted] = continued_outwards(known, self._level.fixed)
            self._active = self._needed
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
        rows, columns = doubled(np.stack(coarser._field[:2]), self._grid.size)
        stride = self._grid.stride
        height, width = self._grid.counts
        rows, columns = rows[::stride, ::stride], columns[::stride, ::stride]
        self._field = Field.of(*self._onto_allowed(rows[:height, :width], columns[:height, :width]))
        barred = doubled(np.moveaxis(coarser._barred, -1, 0), self._grid.size)
        barred = barred[:, ::stride, ::stride][:, :height, :width]
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
        self._bar_long_copies()
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

    def _bar_long_copies(self) -> None:
        """Let patches in the midst of what is late not use what they use."""
        share = self._task.longest_copy
        if share is None:
            return
        half = self._grid.side // 2
        longest = [int(share * length) - half for length in self._level.usable.shape]
        if min(longest) < self._grid.side:
            return
        wraps = self._task.tileable
        spoilt = late(self.place, (longest[0], longest[1]), wraps=wraps)
        if not spoilt.any():
            return
        rows, columns = self._grid.places(0, half), self._grid.places(1, half)
        middles = self.place[rows[:, np.newaxis], columns] - half
        uses = np.stack(self._field[:2], axis=-1)
        found = spoilt[rows[:, np.newaxis], columns] & (middles == uses).all(axis=-1)
        self._barred[found] = uses[found]
        self._active |= found

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
