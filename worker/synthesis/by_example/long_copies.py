"""Where too much is copied in one line: the way out that every measure of likeness rewards.

Nothing is as like an exemplar as the exemplar. Lines of pixels that continue each other are
followed from where they begin; what comes after the longest line that is wished is late, and has to
come from elsewhere.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from worker.numba_kernel import kernel

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from worker.synthesis.by_example.patch_grid import Cover

    Mask = NDArray[np.bool_]
    Integers = NDArray[np.int32]


def late(place: Integers, longest: tuple[int, int], *, wraps: bool) -> Mask:
    """Return which pixels come after the longest line that may be copied, (height, width).

    Args:
        place: Row and column of the source of each pixel, (height, width, 2).
        longest: How many pixels may be copied in one line downwards, and how many across.
        wraps: Whether lines go on around the edges.
    """
    found = np.zeros(place.shape[:2], np.bool_)
    _follow(place, *longest, 2 if wraps else 1, found)
    return found


def bar(
    spoilt: Mask,
    place: Integers,
    field: tuple[Integers, Integers, Integers],
    covers: tuple[Cover, Cover],
    barred: Integers,
) -> Mask:
    """Bar patches that propose what is spoilt from their source patch; return which they are.

    Args:
        spoilt: Pixels that have to come from elsewhere, (height, width).
        place: Where they come from, (height, width, 2).
        field: The source patch of every target patch, and costs.
        covers: Of rows and of columns.
        barred: The source patch that each target patch must not use, (rows, columns, 2).
    """
    found = np.zeros(barred.shape[:2], np.bool_)
    rows, columns = np.nonzero(spoilt)
    _bar(rows, columns, place, field[0], field[1], *covers[0], *covers[1], found)
    barred[found] = np.stack([field[0][found], field[1][found]], axis=-1)
    return found


@kernel
def _bar(
    ys: NDArray[np.int64],
    xs: NDArray[np.int64],
    place: Integers,
    rows: Integers,
    columns: Integers,
    row_patches: Integers,
    row_inner: Integers,
    column_patches: Integers,
    column_inner: Integers,
    found: Mask,
) -> None:
    for k in range(len(ys)):
        y, x = ys[k], xs[k]
        for j in range(row_patches.shape[1]):
            for i in range(column_patches.shape[1]):
                above, left = row_patches[y, j], column_patches[x, i]
                if above < 0 or left < 0:
                    continue
                same_row = rows[above, left] + row_inner[y, j] == place[y, x, 0]
                if same_row and columns[above, left] + column_inner[x, i] == place[y, x, 1]:
                    found[above, left] = True


@kernel
def _follow(place: Integers, down: int, across: int, times: int, found: Mask) -> None:
    height, width = found.shape
    for y in range(height):
        length = 0
        for step in range(width * times):
            x = step % width
            before = (x - 1) % width
            goes_on = (
                place[y, x, 0] == place[y, before, 0] and place[y, x, 1] == place[y, before, 1] + 1
            )
            length = length + 1 if goes_on and step > 0 else 1
            if length > across:
                found[y, x] = True
    lengths = np.zeros(width, np.int64)
    for step in range(height * times):
        y = step % height
        before = (y - 1) % height
        for x in range(width):
            goes_on = (
                place[y, x, 0] == place[before, x, 0] + 1 and place[y, x, 1] == place[before, x, 1]
            )
            lengths[x] = lengths[x] + 1 if goes_on and step > 0 else 1
            if lengths[x] > down:
                found[y, x] = True
