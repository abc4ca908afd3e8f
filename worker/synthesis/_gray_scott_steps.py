"""Several steps of Gray and Scott's chemicals in one pass over the dish.

A block of rows is led through all steps of a pass while it is in the cache (temporal blocking;
Wellein et al., 2009): step t of row y follows step t - 1 of row y + 1, and of each step only the
last rows are kept. The rows around a block are computed again by its neighbours, to the same
numbers: the pixels do not depend on the blocks.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np

from worker.numba_kernel import by_type, is_array, kernel, parallel_kernel, prange

if TYPE_CHECKING:
    from collections.abc import Callable

    from numpy.typing import NDArray

    Field = NDArray[np.float32]
    Rate: TypeAlias = np.float32 | Field
    Rates: TypeAlias = tuple[Rate, ...]

STEPS_AT_ONCE = 8
BORDERS = {"torus": 0, "no_flux": 1, "fixed": 2}
_BLOCK_ROWS = 128
_KEPT = 4
"""Rows of a step that are kept: three are read, a power of two counts fast."""


def along(rate: Rate, row: int) -> Rate:
    """Return a number, or what an array of one row or of all has for a row of cells from 1."""
    return rate if isinstance(rate, np.float32) else rate[min(row, len(rate)) - 1]


def value(rate: Rate, x: int) -> Any:
    """Return a number, or what a row has for a cell."""
    return rate if isinstance(rate, np.float32) else rate[x]


@by_type(along)
def _along(rate: Any, row: Any) -> Callable[..., Any]:
    if is_array(rate):
        return lambda rate, row: rate[min(row, len(rate)) - 1]
    return lambda rate, row: rate


@by_type(value)
def _value(rate: Any, x: Any) -> Callable[..., Any]:
    if is_array(rate):
        return lambda rate, x: rate[x]
    return lambda rate, x: rate


@parallel_kernel
def advance(after: Field, before: Field, rates: Rates, steps: int, border: int) -> None:
    """Lead (height + 2, 2, width + 2) cells through up to STEPS_AT_ONCE steps.

    The rim's columns must be set, and are again afterwards; of its rows only fixed ones are read.
    """
    height = len(before) - 2
    for block in prange((height + _BLOCK_ROWS - 1) // _BLOCK_ROWS):
        kept = np.empty((steps, _KEPT, 2, before.shape[2]), np.float32)
        first = 1 + block * _BLOCK_ROWS
        end = min(first + _BLOCK_ROWS, height + 1)
        for wave in range(first - steps + 2, end + steps):
            for step in range(1, steps + 1):
                y = wave - step
                margin = steps - step
                outside = border != 0 and (y < 1 or y > height)
                if outside or y < first - margin or y >= end + margin:
                    continue
                target = after[y] if step == steps else kept[step, y % _KEPT]
                _step_row(target, before, kept, rates, step - 1, y, border)


@parallel_kernel
def fill_changes(changes: Field, before: Field, after: Field) -> None:
    """Fill (height,) with the largest change of any cell in each row, the rim left out."""
    for row in prange(len(changes)):
        largest = np.float32(0)
        for chemical in range(2):
            old, new = before[row + 1, chemical], after[row + 1, chemical]
            for x in range(1, len(old) - 1):
                largest = max(largest, abs(new[x] - old[x]))
        changes[row] = largest


@kernel
def _step_row(
    target: Field, before: Field, kept: Field, rates: Rates, step: int, y: int, border: int
) -> None:
    """Fill both chemicals of a row from the rows around it one step earlier."""
    row = (y - 1) % (len(before) - 2) + 1
    above = _row(before, kept, step, y - 1, border)
    here = _row(before, kept, step, y, border)
    below = _row(before, kept, step, y + 1, border)
    _step_u(
        target[0], above[0], here[0], below[0], here[1], along(rates[0], row), along(rates[2], row)
    )
    _close(target[0], border, np.float32(1))
    _step_v(
        target[1],
        above[1],
        here[1],
        below[1],
        target[0],
        along(rates[1], row),
        along(rates[3], row),
    )
    _close(target[1], border, np.float32(0))


@kernel
def _row(before: Field, kept: Field, step: int, y: int, border: int) -> Field:
    """Return both chemicals of a row after a step, or what lies beyond the edge in its place."""
    height = len(before) - 2
    row: Field
    if border == 2 and (y < 1 or y > height):
        row = before[0 if y < 1 else height + 1]
    else:
        if border == 1:
            y = min(max(y, 1), height)
        row = before[(y - 1) % height + 1] if step == 0 else kept[step, y % _KEPT]
    return row


@kernel
def _close(row: Field, border: int, rest: np.float32) -> None:
    width = len(row) - 2
    if border == 0:
        row[0], row[width + 1] = row[width], row[1]
    elif border == 1:
        row[0], row[width + 1] = row[1], row[width]
    else:
        row[0], row[width + 1] = rest, rest


@kernel
def _step_u(
    after: Field, above: Field, u: Field, below: Field, v: Field, feed: Rate, diffusion: Rate
) -> None:
    one, four = np.float32(1), np.float32(4)
    for x in range(1, len(u) - 1):
        around = above[x] + below[x] + u[x - 1] + u[x + 1]
        spread = value(diffusion, x) * (around - four * u[x])
        flow = value(feed, x)
        after[x] = (u[x] + spread + flow) / (one + flow + v[x] * v[x])


@kernel
def _step_v(
    after: Field, above: Field, v: Field, below: Field, u: Field, loss: Rate, diffusion: Rate
) -> None:
    four, zero, nothing = np.float32(4), np.float32(0), np.float32(1e-15)
    # Traces are cleared away: the numbers below float32's normal ones are slow to compute with
    for x in range(1, len(v) - 1):
        around = above[x] + below[x] + v[x - 1] + v[x + 1]
        spread = value(diffusion, x) * (around - four * v[x])
        left = v[x] + spread + u[x] * (v[x] * v[x]) - value(loss, x) * v[x]
        after[x] = left if left > nothing else zero
