"""The seam between two pictures where they differ least, by dynamic programming."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from worker.numba_kernel import kernel

if TYPE_CHECKING:
    from numpy.typing import NDArray


def least_seam(apart: NDArray[np.float64]) -> tuple[NDArray[np.bool_], float]:
    """Cut a square from its upper left corner to its lower right one.

    The seam goes right, down or both at each step. It keeps away from the sides where the other
    picture is at home: it is at most as far from the diagonal as from both of its ends.

    Args:
        apart: How much both pictures differ at each pixel, (n, n).

    Returns:
        Where the picture above and right of the seam is shown, and the mean difference along it.
    """
    mask = np.zeros(apart.shape, np.bool_)
    # Differences no float64 sums are too large to matter
    cost = _cut(mask, np.nan_to_num(np.minimum(apart, 1e100), nan=1e100))
    return mask, cost


def warm() -> None:
    """Compile the kernels."""
    least_seam(np.zeros((2, 2)))


@kernel
def _cut(mask: NDArray[np.bool_], apart: NDArray[np.float64]) -> float:
    side = len(apart)
    total = np.full((side, side), np.inf)
    total[0, 0] = apart[0, 0]
    for row in range(side):
        for column in range(side):
            ends = min(row + column, 2 * (side - 1) - row - column)
            if row + column == 0 or 2 * abs(row - column) > ends:
                continue
            best = np.inf
            if row > 0:
                best = min(best, total[row - 1, column])
            if column > 0:
                best = min(best, total[row, column - 1])
            if row > 0 and column > 0:
                best = min(best, total[row - 1, column - 1])
            total[row, column] = best + apart[row, column]
    row, column, length = side - 1, side - 1, 1
    mask[row, column + 1 :] = True
    while row > 0 or column > 0:
        above = total[row - 1, column] if row > 0 else np.inf
        left = total[row, column - 1] if column > 0 else np.inf
        both = total[row - 1, column - 1] if row > 0 and column > 0 else np.inf
        if both <= above and both <= left:
            row, column = row - 1, column - 1
            mask[row, column + 1 :] = True
        elif above <= left:
            row -= 1
            mask[row, column + 1 :] = True
        else:
            column -= 1
        length += 1
    mean: float = total[side - 1, side - 1] / length
    return mean
