"""Fields of nearest patches that lie turned and scaled in the exemplar (Barnes et al., 2010).

As in `patch_match`, but that a source patch has an angle and a scale besides its place: what lies
beside a target patch is expected beside the source patch as it is turned there, and the random
search narrows down on all four at once.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from worker.numba_kernel import parallel_kernel, prange
from worker.synthesis._counter_hash import hashes
from worker.synthesis.by_example.hashing import below, scrambled
from worker.synthesis.by_example.patch_match import BAND_ROWS, NEVER
from worker.synthesis.by_example.turned_patches import (
    OCTAVE,
    PIXEL,
    TURN,
    Pair,
    axis,
    meet,
    near,
    near_angle,
)
from worker.synthesis.by_example.windows import whole_windows

if TYPE_CHECKING:
    from collections.abc import Iterator

    from numpy.typing import NDArray

    from worker.synthesis.by_example.arrays import Integers

_FIRST_TRIES = 4
_TRIES = 2
_FINEST = PIXEL // 8


class TurnedField(NamedTuple):
    """For every target patch its source patch and what that costs, (rows, columns) each.

    Attributes:
        rows: Of its middle, in 1/256 pixel.
        columns: Likewise.
        angles: How far it lies turned, anticlockwise, in 1/1024 of a turn, -512..512.
        scales: How much larger it is, in 1/32 octave.
        costs: Sums of squared differences.
    """

    rows: Integers
    columns: Integers
    angles: Integers
    scales: Integers
    costs: Integers

    def places(self, down: NDArray[np.float64], across: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return row and column, in pixels, of what lies so far from the middles, (.., 2)."""
        angle, scale = self.radians, self.factors
        cosine, sine = scale * np.cos(angle), scale * np.sin(angle)
        rows = self.rows / PIXEL + cosine * down - sine * across
        columns = self.columns / PIXEL + sine * down + cosine * across
        return np.stack([rows, columns], axis=-1)

    @property
    def radians(self) -> NDArray[np.float64]:
        """The angles in radians."""
        return np.asarray(self.angles * (2 * math.pi / TURN))

    @property
    def factors(self) -> NDArray[np.float64]:
        """The scales as factors."""
        return np.asarray(2.0 ** (self.scales / OCTAVE))


def turned_field(pair: Pair, seed: int) -> Iterator[TurnedField]:
    """Yield a random field, then the same one after each pass, without end.

    Args:
        pair: Of which at least one source patch, as it lies, is usable.
        seed: Of the random numbers.
    """
    side = pair.side
    corners = np.argwhere(whole_windows(pair.usable, (side, side)))
    shape = (pair.target.shape[0] - side + 1, pair.target.shape[1] - side + 1)
    field = TurnedField(*np.full((5, *shape), NEVER, np.int32))
    _begin(pair, field, corners, hashes(seed, 0, 1)[0])
    yield field
    iteration = 0
    while True:
        _improve(pair, field, iteration, hashes(seed, 1 + iteration, 1)[0], BAND_ROWS)
        yield field
        iteration += 1


@parallel_kernel
def _begin(pair: Pair, field: TurnedField, corners: NDArray[np.int64], key: np.uint64) -> None:
    """Choose a patch as it lies, and try some that lie in other ways."""
    rows, columns, angles, scales, costs = field
    height, width = costs.shape
    widest = len(pair.factors) // 2
    bottom, right = (pair.source.shape[0] - 1) << 8, (pair.source.shape[1] - 1) << 8
    for y in prange(height):
        best = np.empty(5, np.int64)
        for x in range(width):
            counter = (y * width + x) * 256
            corner = corners[below(scrambled(key, counter), len(corners))]
            best[4] = NEVER
            middle = PIXEL // 2 * (pair.side - 1)
            v, u = PIXEL * int(corner[0]) + middle, PIXEL * int(corner[1]) + middle
            meet(pair, y, x, v, u, 0, 0, best)
            for turn in range(_FIRST_TRIES):
                bits = scrambled(key, counter + 2 * turn + 1)
                more = scrambled(key, counter + 2 * turn + 2)
                v, u = (
                    near(bits, 0, bottom, 0, bottom),
                    near(bits >> np.uint64(32), 0, right, 0, right),
                )
                angle = near_angle(more, 0, pair.furthest, pair.furthest)
                scale = near(more >> np.uint64(32), 0, widest, -widest, widest)
                meet(pair, y, x, v, u, angle, scale, best)
            rows[y, x], columns[y, x], costs[y, x] = best[0], best[1], best[4]
            angles[y, x], scales[y, x] = best[2], best[3]


@parallel_kernel
def _improve(
    pair: Pair, field: TurnedField, iteration: int, key: np.uint64, band_rows: int
) -> None:
    rows, columns, angles, scales, costs = field
    height, width = costs.shape
    widest = len(pair.factors) // 2
    bottom, right = (pair.source.shape[0] - 1) << 8, (pair.source.shape[1] - 1) << 8
    shift = band_rows // 2 if iteration % 2 == 1 else 0
    step = 1 if iteration % 2 == 0 else -1
    for band in prange((height + shift + band_rows - 1) // band_rows):
        first = max(0, band * band_rows - shift)
        last = min(height, (band + 1) * band_rows - shift)
        best = np.empty(5, np.int64)
        for row in range(last - first):
            y = first + row if step == 1 else last - 1 - row
            for column in range(width):
                x = column if step == 1 else width - 1 - column
                best[0], best[1], best[4] = rows[y, x], columns[y, x], costs[y, x]
                best[2], best[3] = angles[y, x], scales[y, x]
                for down, across in ((0, step), (step, 0), (0, -step), (-step, 0)):
                    near_y, near_x = y - down, x - across
                    if not (first <= near_y < last and 0 <= near_x < width):
                        continue
                    angle, scale = angles[near_y, near_x], scales[near_y, near_x]
                    along, beside = axis(pair, angle, scale)
                    v = rows[near_y, near_x] + ((along * down - beside * across + 128) >> 8)
                    u = columns[near_y, near_x] + ((beside * down + along * across + 128) >> 8)
                    meet(pair, y, x, v, u, angle, scale, best)
                reach, turning, scaling = max(bottom, right), pair.furthest, widest
                turn = 0
                while reach >= _FINEST:
                    counter = (y * width + x) * 256 + 2 * turn
                    bits, more = scrambled(key, counter), scrambled(key, counter + 1)
                    v = near(bits, best[0], reach, 0, bottom)
                    u = near(bits >> np.uint64(32), best[1], reach, 0, right)
                    angle = near_angle(more, best[2], turning, pair.furthest)
                    scale = near(more >> np.uint64(32), best[3], scaling, -widest, widest)
                    meet(pair, y, x, v, u, angle, scale, best)
                    turn += 1
                    if turn % _TRIES == 0:
                        reach //= 2
                        turning = max(min(pair.furthest, 1), turning // 2)
                        scaling = max(min(widest, 1), scaling // 2)
                rows[y, x], columns[y, x], costs[y, x] = best[0], best[1], best[4]
                angles[y, x], scales[y, x] = best[2], best[3]
