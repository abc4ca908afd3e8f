"""Fields of nearest patches by random search (Barnes et al., 2009).

Patches are named by their upper left corner and compared by the sum of squared differences. The
field is improved in bands of rows of fixed size, side by side; in every other iteration the bands
begin half a band higher, so that nothing stops at their borders.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from worker.byte_squares import WIDTH, counting, squares
from worker.numba_kernel import kernel, parallel_kernel, prange
from worker.synthesis._counter_hash import hashes
from worker.synthesis.by_example.hashing import below, scrambled

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Bytes = NDArray[np.uint8]
    Integers = NDArray[np.int32]

BAND_ROWS = 128
NEVER = 2**31 - 1
"""A cost that no patch has: of source patches that must not be used."""
NONE_BARRED = np.zeros((0, 0, 2), np.int32)


class Field(NamedTuple):
    """For every target patch its source patch and what that costs, (rows, columns) each."""

    rows: Integers
    columns: Integers
    costs: Integers

    @classmethod
    def of(cls, rows: Integers, columns: Integers) -> Field:
        """Begin with given source patches, whose costs are not known yet."""
        return cls(rows, columns, np.full(rows.shape, NEVER, np.int32))


def lines(features: Bytes) -> Bytes:
    """Lay the channels of a row of pixels beside each other, and go on for as much as is read."""
    rows = np.ascontiguousarray(features).reshape(len(features), -1)
    return np.pad(rows, ((0, 0), (0, WIDTH - 1)))


class Patches(NamedTuple):
    """What is compared: lines of bytes, (rows, columns x channels), of target and source.

    Attributes:
        target: With patches at multiples of `stride`.
        source: With patches at every pixel.
        penalties: What using a source patch costs beyond the difference; NEVER forbids it.
        side: Of a patch, in pixels.
        channels: Bytes per pixel.
        stride: Pixels from one target patch to the next.
        barred: A source patch, (rows, columns, 2), that each target patch must not use, nor one
            nearer to it than half a patch; NONE_BARRED bars none.
    """

    target: Bytes
    source: Bytes
    penalties: Integers
    side: int
    channels: int
    stride: int
    barred: Integers = NONE_BARRED


def evaluate(patches: Patches, field: Field, active: NDArray[np.bool_]) -> None:
    """Fill in the costs of the field as it is, where patches are active."""
    _evaluate(*patches, *field, active, counting(patches.side * patches.channels))


def improve(
    patches: Patches,
    field: Field,
    active: NDArray[np.bool_],
    *,
    iteration: int,
    seed: int,
    radius: int,
    tries: int = 1,
    band_rows: int = BAND_ROWS,
) -> None:
    """Improve a field whose costs are known, in place: no cost ever rises.

    Even iterations learn from the left and from above, odd ones from the right and from below, and
    all try random source patches at up to `radius` pixels from the best, then half as far, and on.

    Args:
        patches: What is compared.
        field: Improved in place.
        active: Which target patches are looked at, (rows, columns).
        iteration: Decides the direction, the bands and the random numbers.
        seed: Of the random numbers.
        radius: How far away the random search begins.
        tries: Random patches looked at before the radius is halved.
        band_rows: Rows that learn from each other.
    """
    key = hashes(seed, iteration, 1)[0]
    counts = counting(patches.side * patches.channels)
    _improve(*patches, *field, active, counts, iteration, key, radius, tries, band_rows)


@kernel
def difference(
    target: Bytes,
    source: Bytes,
    place: tuple[int, int, int, int],
    size: tuple[int, int],
    counts: Bytes,
    limit: int,
) -> np.int64:
    """Return the squared difference of two pieces, or any number >= limit if it is that large.

    Args:
        target: Lines of bytes.
        source: Likewise.
        place: Row and byte of the target's piece, then of the source's.
        size: How many rows and bytes they have.
        counts: Made by `counting` for so many bytes.
        limit: Of what is of interest.
    """
    total = np.int64(0)
    for line in range(size[0]):
        row, other_row = place[0] + line, place[2] + line
        for i in range(0, size[1], WIDTH):
            total += squares(target, row, place[1] + i, source, other_row, place[3] + i, counts, i)
        if total >= limit:
            return total
    return total


@kernel
def _is_barred(barred: Integers, side: int, y: int, x: int, v: int, u: int) -> bool:
    if barred.shape[0] == 0:
        return False
    near_row = 2 * abs(v - barred[y, x, 0]) < side
    return bool(near_row and 2 * abs(u - barred[y, x, 1]) < side)


@parallel_kernel
def _evaluate(
    target: Bytes,
    source: Bytes,
    penalties: Integers,
    side: int,
    channels: int,
    stride: int,
    barred: Integers,
    rows: Integers,
    columns: Integers,
    costs: Integers,
    active: NDArray[np.bool_],
    counts: Bytes,
) -> None:
    size = (side, side * channels)
    for y in prange(rows.shape[0]):
        for x in range(rows.shape[1]):
            if not active[y, x]:
                continue
            v, u = rows[y, x], columns[y, x]
            penalty = penalties[v, u]
            costs[y, x] = NEVER
            if penalty < NEVER and not _is_barred(barred, side, y, x, v, u):
                place = (y * stride, x * stride * channels, v, u * channels)
                costs[y, x] = penalty + difference(target, source, place, size, counts, NEVER)


@parallel_kernel
def _improve(
    target: Bytes,
    source: Bytes,
    penalties: Integers,
    side: int,
    channels: int,
    stride: int,
    barred: Integers,
    rows: Integers,
    columns: Integers,
    costs: Integers,
    active: NDArray[np.bool_],
    counts: Bytes,
    iteration: int,
    key: np.uint64,
    radius: int,
    tries: int,
    band_rows: int,
) -> None:
    size = (side, side * channels)
    height, width = rows.shape
    bottom, right = penalties.shape
    shift = band_rows // 2 if iteration % 2 == 1 else 0
    step = 1 if iteration % 2 == 0 else -1
    for band in prange((height + shift + band_rows - 1) // band_rows):
        first = max(0, band * band_rows - shift)
        last = min(height, (band + 1) * band_rows - shift)
        for row in range(last - first):
            y = first + row if step == 1 else last - 1 - row
            for column in range(width):
                x = column if step == 1 else width - 1 - column
                if not active[y, x]:
                    continue
                best, best_v, best_u = costs[y, x], rows[y, x], columns[y, x]
                for down, across in ((0, step), (step, 0), (0, -step), (-step, 0)):
                    near_y, near_x = y - down, x - across
                    if not (first <= near_y < last and 0 <= near_x < width):
                        continue
                    v = rows[near_y, near_x] + down * stride
                    u = columns[near_y, near_x] + across * stride
                    if not (0 <= v < bottom and 0 <= u < right) or (v == best_v and u == best_u):
                        continue
                    penalty = penalties[v, u]
                    if penalty < best and not _is_barred(barred, side, y, x, v, u):
                        place = (y * stride, x * stride * channels, v, u * channels)
                        cost = penalty + difference(
                            target, source, place, size, counts, best - penalty
                        )
                        if cost < best:
                            best, best_v, best_u = cost, v, u
                reach = min(radius, max(bottom, right))
                turn = 0
                while reach >= 1:
                    bits = scrambled(key, (y * width + x) * 64 + turn)
                    low_v, low_u = max(0, best_v - reach), max(0, best_u - reach)
                    v = low_v + below(bits, min(bottom, best_v + reach + 1) - low_v)
                    u = low_u + below(bits >> np.uint64(32), min(right, best_u + reach + 1) - low_u)
                    penalty = penalties[v, u]
                    if penalty < best and not _is_barred(barred, side, y, x, v, u):
                        place = (y * stride, x * stride * channels, v, u * channels)
                        cost = penalty + difference(
                            target, source, place, size, counts, best - penalty
                        )
                        if cost < best:
                            best, best_v, best_u = cost, v, u
                    turn += 1
                    if turn % tries == 0:
                        reach //= 2
                costs[y, x], rows[y, x], columns[y, x] = best, best_v, best_u
