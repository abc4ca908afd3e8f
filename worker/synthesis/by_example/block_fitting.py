"""Blocks of an exemplar laid so that each continues its neighbours: a start for optimisation.

Whatever is within a block fits perfectly, and large ones have structure at once. They are laid one
after the other, each where it continues its neighbours best (as Efros and Freeman, 2001, quilt),
and chosen once more when all neighbours are known: little is left to mend between them.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from worker.byte_squares import counting
from worker.numba_kernel import kernel
from worker.synthesis._counter_hash import uniforms
from worker.synthesis.by_example.patch_match import NEVER, difference, lines
from worker.synthesis.by_example.starting import random_blocks
from worker.synthesis.by_example.uses import Uses
from worker.synthesis.by_example.windows import whole_windows

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from worker.synthesis.by_example.patch_grid import PatchGrid

    Bytes = NDArray[np.uint8]
    Mask = NDArray[np.bool_]
    Integers = NDArray[np.int64]

_EVENNESS, _SAMENESS, _CHANCE = 5.0, 0.35, 0.15
"""What using each pixel once more, being nearly another block, and chance weigh beside how well
a block continues."""
_SWEEPS = 2


def fitting_blocks(
    grid: PatchGrid, source: Bytes, allowed: Mask, size: tuple[int, int], seed: int, use: int
) -> tuple[Integers, Integers]:
    """Return rows and columns of source patches: blocks that continue each other well.

    Of blocks that do, those are preferred whose pixels have not been used yet, and that are not
    nearly the same as others: blocks lie in rows and columns, where the eye finds what comes back.
    None continues its neighbour in the source itself. Where the source has no room for them, blocks
    are random.

    Args:
        grid: Of the target's patches.
        source: Features, (height, width, channels).
        allowed: Which patches of the source may be used.
        size: Height and width of a block in pixels, nearly: they divide the target evenly.
        seed: Of the random numbers.
        use: Another one, other blocks.
    """
    places = [np.arange(count) * grid.stride for count in grid.counts]
    edges = [_divided(int(at[-1]) + 1, side) for at, side in zip(places, size, strict=True)]
    height, width = (int(np.diff(marks).max()) for marks in edges)
    free = whole_windows(allowed, (height, width))
    if not free.any():
        return random_blocks(grid, (allowed.shape[0], allowed.shape[1]), min(size), seed, use)
    choice = _Choice(source, free, (height, width), grid.side)
    starts = np.full((len(edges[0]) - 1, len(edges[1]) - 1, 2), -1, np.int64)
    for number, block in enumerate(_SWEEPS * list(np.ndindex(*starts.shape[:2]))):
        chance = uniforms(seed, 2**16 + use, free.size, number * free.size).reshape(free.shape)
        choice.use(starts[block], -1)
        starts[block] = choice.best(_beside(starts, block, wraps=grid.wraps), chance)
        choice.use(starts[block], 1)
    within = [
        np.searchsorted(marks, at, "right") - 1 for marks, at in zip(edges, places, strict=True)
    ]
    inner = [at - marks[of] for at, marks, of in zip(places, edges, within, strict=True)]
    first = starts[within[0][:, np.newaxis], within[1]]
    return first[..., 0] + inner[0][:, np.newaxis], first[..., 1] + inner[1]


class _Neighbour(NamedTuple):
    """A block beside another: which way (rows down, columns across), and where it is taken from."""

    down: int
    across: int
    row: int
    column: int


class _Choice:
    """Blocks of a source, of which one after the other is taken."""

    def __init__(self, source: Bytes, free: Mask, size: tuple[int, int], side: int) -> None:
        self._lines, self._channels = lines(source), source.shape[2]
        self._free, self._size, self._side = free, size, side
        self._uses = Uses((source.shape[0], source.shape[1]))
        self._nearly = np.zeros(free.shape, np.int64)

    def best(self, beside: list[_Neighbour], chance: NDArray[np.float64]) -> tuple[int, int]:
        """Return the corner of the block that continues its neighbours best."""
        height, width = self._size
        costs = np.zeros(self._free.shape, np.int64)
        barred = ~self._free
        rows, columns = np.indices(self._free.shape)
        for near in beside:
            self._compare(near, costs)
            barred |= (np.abs(rows - near.row + near.down * height) < self._side) & (
                np.abs(columns - near.column + near.across * width) < self._side
            )
        if barred.all():
            barred = ~self._free
        scale = np.median(costs) if beside else 1.0
        # Blocks of patches reach beyond blocks of their corners: fewer of them fit
        down, across = self._free.shape
        uses = self._uses.of_windows(self._size)[:down, :across]
        worse = _EVENNESS * uses + _SAMENESS * self._nearly + _CHANCE * chance
        scores = costs + scale * worse
        scores[barred] = np.inf
        v, u = (int(k) for k in np.unravel_index(scores.argmin(), scores.shape))
        return v, u

    def use(self, corner: Integers, times: int) -> None:
        """Note that the pixels of a block are used so many times more; (-1, -1) is none."""
        v, u = corner
        if v >= 0:
            height, width = self._size
            rows, columns = np.ogrid[v : v + height, u : u + width]
            self._uses.count(rows, columns, times)
            down, across = height // 4, width // 4
            near = np.s_[max(0, v - down) : v + down + 1, max(0, u - across) : u + across + 1]
            self._nearly[near] += times

    def _compare(self, near: _Neighbour, costs: Integers) -> None:
        """Add what blocks and a neighbour differ by where either continues into the other."""
        (height, width), overlap = self._size, max(1, self._side - 1)
        size = (height if near.across else overlap, width if near.down else overlap)
        _compare(
            self._lines,
            self._channels,
            (max(near.down, 0) * height, max(near.across, 0) * width),
            (near.row + max(-near.down, 0) * height, near.column + max(-near.across, 0) * width),
            size,
            counting(size[1] * self._channels),
            costs,
        )


def _divided(length: int, side: int) -> Integers:
    """Return where equal parts of about `side` begin and end."""
    count = max(1, round(length / side))
    return np.arange(count + 1) * length // count


def _beside(starts: Integers, block: tuple[int, ...], *, wraps: bool) -> list[_Neighbour]:
    """Return the other blocks around one, as far as they have been chosen already."""
    found = []
    for down, across in ((0, -1), (0, 1), (-1, 0), (1, 0)):
        y, x = block[0] + down, block[1] + across
        if wraps:
            y, x = y % starts.shape[0], x % starts.shape[1]
        inside = 0 <= y < starts.shape[0] and 0 <= x < starts.shape[1]
        if inside and (y, x) != block and starts[y, x, 0] >= 0:
            found.append(_Neighbour(down, across, int(starts[y, x, 0]), int(starts[y, x, 1])))
    return found


@kernel
def _compare(
    source: Bytes,
    channels: int,
    ours: tuple[int, int],
    theirs: tuple[int, int],
    size: tuple[int, int],
    counts: Bytes,
    costs: Integers,
) -> None:
    extent = (size[0], size[1] * channels)
    for v in range(costs.shape[0]):
        for u in range(costs.shape[1]):
            place = (theirs[0], theirs[1] * channels, v + ours[0], (u + ours[1]) * channels)
            costs[v, u] += difference(source, source, place, extent, counts, NEVER)
