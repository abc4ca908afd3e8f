"""Windows of a picture, named by their upper left corners."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Mask = NDArray[np.bool_]


def whole_windows(mask: Mask, size: tuple[int, int]) -> Mask:
    """Return which windows of (height, width) hold nothing but True.

    Their corners: one row and column for each place where the window fits, none where none does.
    """
    height, width = size
    sums = np.pad(np.cumsum(np.cumsum(~mask, axis=0), axis=1), ((1, 0), (1, 0)))
    rows: NDArray[np.int64] = sums[height:] - sums[: max(0, len(sums) - height)]
    spoilt: NDArray[np.int64] = rows[:, width:] - rows[:, : max(0, rows.shape[1] - width)]
    return np.asarray(spoilt == 0)


def fitting_side(usable: Mask, size: tuple[int, int], side: int) -> int:
    """Return the side of the largest square up to `side` that fits `size` and what is usable."""
    side = min(side, *usable.shape, *size)
    while side > 1 and not whole_windows(usable, (side, side)).any():
        side -= 1
    return side


def middles(mask: Mask, size: tuple[int, int]) -> Mask:
    """Return which pixels, (height, width) of the mask, are the middle of a window of True."""
    found = np.zeros(mask.shape, bool)
    whole = whole_windows(mask, size)
    top, left = size[0] // 2, size[1] // 2
    found[top : top + whole.shape[0], left : left + whole.shape[1]] = whole
    return found
