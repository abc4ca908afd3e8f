"""Patches that lie turned and scaled in an exemplar, compared in whole numbers.

A state is a source patch: the row and column of its middle in 1/256 pixel, its angle in 1/1024 of a
turn anticlockwise, and its scale in 1/32 octave. What lies between pixels is interpolated.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from worker.numba_kernel import kernel
from worker.synthesis.by_example.hashing import below
from worker.synthesis.by_example.patch_match import NEVER

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from worker.synthesis.by_example.arrays import Bytes, Mask

    Integers = NDArray[np.int64]

PIXEL, TURN, OCTAVE = 256, 1024, 32
"""How many steps of places, angles and scales there are in each."""
_ONE = 65536


class Pair(NamedTuple):
    """What is compared, and in which ways.

    Attributes:
        target: Features, (height, width, channels).
        source: Likewise.
        usable: Which pixels of the source a patch may hold.
        everywhere: Whether all of them.
        side: Of a patch, in pixels.
        cosines: Of all angles, in 1/65536.
        sines: Likewise.
        factors: Of all scales from the smallest to the largest, in 1/65536.
        furthest: The largest angle either way.
    """

    target: Bytes
    source: Bytes
    usable: Mask
    everywhere: bool
    side: int
    cosines: Integers
    sines: Integers
    factors: Integers
    furthest: int

    @classmethod
    def of(
        cls,
        target: Bytes,
        source: Bytes,
        usable: Mask,
        side: int,
        rotations: float,
        scales: float,
    ) -> Pair:
        """Look for patches turned by up to so many radians, and up to so many times as large."""
        turns = np.arange(TURN) * (2 * np.pi / TURN)
        widest = int(OCTAVE * math.log2(scales) + 1e-9)
        factors = 2.0 ** (np.arange(-widest, widest + 1) / OCTAVE)
        furthest = min(TURN // 2, int(TURN * rotations / (2 * math.pi) + 1e-3))
        everywhere = bool(usable.all())
        tables = _whole(np.cos(turns)), _whole(np.sin(turns)), _whole(factors)
        pictures = np.ascontiguousarray(target), np.ascontiguousarray(source)
        return cls(*pictures, np.ascontiguousarray(usable), everywhere, side, *tables, furthest)


def _whole(numbers: NDArray[np.float64]) -> Integers:
    return np.rint(_ONE * numbers).astype(np.int64)


@kernel
def axis(pair: Pair, angle: int, scale: int) -> tuple[int, int]:
    """Return cosine and sine of an angle times a scale, in 1/65536."""
    factor = pair.factors[scale + len(pair.factors) // 2]
    return (
        (pair.cosines[angle % TURN] * factor + 32768) >> 16,
        (pair.sines[angle % TURN] * factor + 32768) >> 16,
    )


@kernel
def difference(
    pair: Pair, y: int, x: int, v: int, u: int, along: int, beside: int, limit: int
) -> int:
    """Return the squared difference of two patches, or any number >= limit if it is that large.

    Args:
        pair: What is compared.
        y: First row of the target's patch.
        x: Its first column.
        v: Row of the middle of the source's patch.
        u: Its column.
        along: Cosine of its angle, times its scale.
        beside: Sine, likewise.
        limit: Of what is of interest.
    """
    source, usable, side = pair.source, pair.usable, pair.side
    reach = (abs(along) + abs(beside)) * (side - 1)
    least, most = (256 - reach) >> 9, (256 + reach) >> 9
    bottom, right = (source.shape[0] - 1) << 8, (source.shape[1] - 1) << 8
    if v + least < 0 or u + least < 0 or v + most > bottom or u + most > right:
        return NEVER
    total = 0
    for i in range(side):
        down = 2 * i - side + 1
        for j in range(side):
            across = 2 * j - side + 1
            p = v + ((along * down - beside * across + 256) >> 9)
            q = u + ((beside * down + along * across + 256) >> 9)
            row, column, below_it, right_of_it = p >> 8, q >> 8, p & 255, q & 255
            next_row, next_column = row + (below_it > 0), column + (right_of_it > 0)
            if not pair.everywhere and not (
                usable[row, column]
                and usable[row, next_column]
                and usable[next_row, column]
                and usable[next_row, next_column]
            ):
                return NEVER
            for channel in range(source.shape[2]):
                upper = (256 - right_of_it) * np.int64(source[row, column, channel])
                upper += right_of_it * np.int64(source[row, next_column, channel])
                lower = (256 - right_of_it) * np.int64(source[next_row, column, channel])
                lower += right_of_it * np.int64(source[next_row, next_column, channel])
                value = ((256 - below_it) * upper + below_it * lower + 32768) >> 16
                step = value - np.int64(pair.target[y + i, x + j, channel])
                total += int(step * step)
        if total >= limit:
            return total
    return total


@kernel
def meet(
    pair: Pair, y: int, x: int, v: int, u: int, angle: int, scale: int, best: Integers
) -> None:
    """Make a state the best, (row, column, angle, scale, cost), if it is better."""
    along, beside = axis(pair, angle, scale)
    cost = difference(pair, y, x, v, u, along, beside, best[4])
    if cost < best[4]:
        best[0], best[1], best[2], best[3], best[4] = v, u, angle, scale, cost


@kernel
def near(bits: np.uint64, middle: int, reach: int, low: int, high: int) -> int:
    """Return a random number within reach of a middle and in low..high."""
    first = max(low, middle - reach)
    return int(first + below(bits, min(high, middle + reach) + 1 - first))


@kernel
def near_angle(bits: np.uint64, middle: int, reach: int, furthest: int) -> int:
    """Return a random angle within reach of a middle; a whole turn has no ends."""
    if 2 * furthest < TURN:
        return near(bits, middle, reach, -furthest, furthest)
    found = int(middle - reach + below(bits, 2 * reach + 1))
    return (found + TURN // 2) % TURN - TURN // 2
