"""What is known around a pixel that is to be chosen."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from worker.numba_kernel import kernel

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from worker.synthesis.by_example.arrays import Bytes, Integers, Mask

    Wholes = NDArray[np.int64]


@kernel
def known_around(
    known: Mask, target: Bytes, weights: Integers, place: tuple[int, int], wraps: bool
) -> tuple[Wholes, Wholes, Wholes]:
    """Find the known pixels around a place that have a weight.

    Args:
        known: Which are, (height, width).
        target: Their numbers, (height, width, channels).
        weights: Of a neighbourhood's pixels, (window, window).
        place: Row and column of its middle.
        wraps: Whether pixels beyond an edge are those of the other side.

    Returns:
        Rows and columns from the middle, (count, 2); weights, (count,); numbers, (count, channels).
    """
    height, width = known.shape
    reach = len(weights) // 2
    steps = np.empty((weights.size, 2), np.int64)
    found = np.empty(weights.size, np.int64)
    values = np.empty((weights.size, target.shape[2]), np.int64)
    count = 0
    for down in range(-reach, reach + 1):
        for right in range(-reach, reach + 1):
            y, x = place[0] + down, place[1] + right
            if wraps:
                y, x = y % height, x % width
            elif not (0 <= y < height and 0 <= x < width):
                continue
            weight = weights[reach + down, reach + right]
            if not known[y, x] or weight == 0:
                continue
            steps[count, 0], steps[count, 1] = down, right
            found[count] = weight
            for channel in range(target.shape[2]):
                values[count, channel] = target[y, x, channel]
            count += 1
    return steps[:count], found[:count], values[:count]
