"""The k nearest patches of a picture, by random search (Barnes et al., 2010).

As in `patch_match`, but that each patch remembers the k best it has met, all of them others, in
ascending order; it learns from all that its neighbours remember, and looks around all of its own.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from worker.byte_squares import counting
from worker.numba_kernel import kernel, parallel_kernel, prange
from worker.synthesis._counter_hash import hashes
from worker.synthesis.by_example.exact import nearest_several
from worker.synthesis.by_example.hashing import below, scrambled
from worker.synthesis.by_example.patch_match import BAND_ROWS, NEVER, difference, lines
from worker.synthesis.by_example.windows import whole_windows

if TYPE_CHECKING:
    from collections.abc import Iterator

    from numpy.typing import NDArray

    from worker.stages import Report

    Bytes = NDArray[np.uint8]
    Mask = NDArray[np.bool_]
    Integers = NDArray[np.int32]

_PATCHES_AT_ONCE = 2048
_FIRST_TRIES = 4


class SeveralField(NamedTuple):
    """For every target patch its best source patches, the nearest first, (rows, columns, k) each.

    Where there are less than k, the cost of the others is NEVER.
    """

    rows: Integers
    columns: Integers
    costs: Integers


class _Compared(NamedTuple):
    """What is compared: lines of bytes of target and source, patches of which may be used.

    Attributes:
        target: As `lines` lays its features out.
        source: The exemplar's.
        allowed: Which of its patches may be used, by their upper left pixels.
        side: Of a patch, in pixels.
        channels: Bytes per pixel.
        counts: Which bytes count, as `counting` tells.
    """

    target: Bytes
    source: Bytes
    allowed: Mask
    side: int
    channels: int
    counts: Bytes


def several_quickly(
    target: Bytes, source: Bytes, usable: Mask, side: int, seed: int, count: int
) -> Iterator[SeveralField]:
    """Yield a random field, then the same one after each pass, without end.

    Args:
        target: Features, (height, width, channels).
        source: Features of the exemplar.
        usable: Which of its pixels a patch may hold; at least one patch has to.
        side: Of a patch, in pixels.
        seed: Of the random numbers.
        count: How many patches are looked for.
    """
    allowed = whole_windows(usable, (side, side))
    shape = (target.shape[0] - side + 1, target.shape[1] - side + 1, count)
    field = SeveralField(
        np.zeros(shape, np.int32), np.zeros(shape, np.int32), np.full(shape, NEVER, np.int32)
    )
    channels = target.shape[2]
    compared = _Compared(
        lines(target), lines(source), allowed, side, channels, counting(side * channels)
    )
    corners = np.flatnonzero(allowed)
    _begin(compared, field, corners, hashes(seed, 0, 1)[0])
    yield field
    iteration = 0
    while True:
        key = hashes(seed, 1 + iteration, 1)[0]
        _improve(compared, field, iteration, key, BAND_ROWS)
        yield field
        iteration += 1


def several_exactly(
    target: Bytes, source: Bytes, usable: Mask, side: int, count: int, report: Report
) -> SeveralField:
    """Return the nearest patches of the source for every patch of the target."""
    shape = (target.shape[0] - side + 1, target.shape[1] - side + 1, count)
    costs, corners = np.empty(shape, np.int32), np.empty(shape, np.int64)
    patches = shape[0] * shape[1]
    flat = costs.reshape(patches, count), corners.reshape(patches, count)
    for start in range(0, patches, _PATCHES_AT_ONCE):
        chosen = np.arange(start, min(start + _PATCHES_AT_ONCE, patches))
        squares, places = nearest_several(target, chosen, source, usable, side, count)
        flat[0][chosen] = np.where(np.isinf(squares), NEVER, squares.astype(np.float64))
        flat[1][chosen] = places
        report(start / patches, "comparing all patches")
    rows, columns = np.divmod(corners.astype(np.int32), np.int32(source.shape[1] - side + 1))
    return SeveralField(rows, columns, costs)


@kernel
def _meet(
    compared: _Compared,
    place: tuple[int, int, int, int],
    rows: Integers,
    columns: Integers,
    costs: Integers,
) -> None:
    """Let a patch remember a source patch if it is better than the worst it remembers."""
    target, source, allowed, side, channels, counts = compared
    _, _, v, u = place
    last = len(costs) - 1
    if not (0 <= v < allowed.shape[0] and 0 <= u < allowed.shape[1]) or not allowed[v, u]:
        return
    for known in range(last + 1):
        if costs[known] < NEVER and rows[known] == v and columns[known] == u:
            return
    lies = (place[0], place[1] * channels, v, u * channels)
    cost = difference(target, source, lies, (side, side * channels), counts, costs[last])
    if cost >= costs[last]:
        return
    slot = last
    while slot > 0 and costs[slot - 1] > cost:
        rows[slot], columns[slot] = rows[slot - 1], columns[slot - 1]
        costs[slot] = costs[slot - 1]
        slot -= 1
    rows[slot], columns[slot], costs[slot] = v, u, cost


@parallel_kernel
def _begin(
    compared: _Compared,
    field: SeveralField,
    corners: NDArray[np.int64],
    key: np.uint64,
) -> None:
    rows, columns, costs = field
    height, width, count = costs.shape
    across = compared.allowed.shape[1]
    for y in prange(height):
        for x in range(width):
            for turn in range(_FIRST_TRIES * count):
                bits = scrambled(key, (y * width + x) * 64 + turn)
                corner = corners[below(bits, len(corners))]
                place = (y, x, corner // across, corner % across)
                _meet(compared, place, rows[y, x], columns[y, x], costs[y, x])


@parallel_kernel
def _improve(
    compared: _Compared,
    field: SeveralField,
    iteration: int,
    key: np.uint64,
    band_rows: int,
) -> None:
    rows, columns, costs = field
    height, width, count = costs.shape
    bottom, right = compared.allowed.shape
    shift = band_rows // 2 if iteration % 2 == 1 else 0
    step = 1 if iteration % 2 == 0 else -1
    for band in prange((height + shift + band_rows - 1) // band_rows):
        first = max(0, band * band_rows - shift)
        last = min(height, (band + 1) * band_rows - shift)
        for row in range(last - first):
            y = first + row if step == 1 else last - 1 - row
            for column in range(width):
                x = column if step == 1 else width - 1 - column
                own = (rows[y, x], columns[y, x], costs[y, x])
                for down, across in ((0, step), (step, 0)):
                    near_y, near_x = y - down, x - across
                    if not (first <= near_y < last and 0 <= near_x < width):
                        continue
                    for k in range(count):
                        v, u = rows[near_y, near_x, k] + down, columns[near_y, near_x, k] + across
                        _meet(compared, (y, x, v, u), *own)
                for k in range(count):
                    reach = max(bottom, right)
                    turn = k * 32
                    while reach >= 1:
                        bits = scrambled(key, (y * width + x) * 256 + turn)
                        low_v, low_u = max(0, own[0][k] - reach), max(0, own[1][k] - reach)
                        v = low_v + below(bits, min(bottom, own[0][k] + reach + 1) - low_v)
                        u = low_u + below(
                            bits >> np.uint64(32), min(right, own[1][k] + reach + 1) - low_u
                        )
                        _meet(compared, (y, x, v, u), *own)
                        turn += 1
                        reach //= 2
