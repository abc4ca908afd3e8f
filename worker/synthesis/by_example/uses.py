"""How often each pixel of a picture has been used, so that others are preferred."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Integers = NDArray[np.int64]


class Uses:
    """A count for each pixel, at first none."""

    def __init__(self, shape: tuple[int, int]) -> None:
        """Begin for a picture of this height and width."""
        self._times = np.zeros(shape, np.int64)

    def count(self, rows: Integers, columns: Integers, times: int = 1) -> None:
        """Count pixels, each so many times (less than 0 takes back) as often as it is named."""
        np.add.at(self._times, (rows, columns), times)

    def of_windows(self, size: tuple[int, int]) -> NDArray[np.float64]:
        """Return how often each window's pixels have been used, as a multiple of all pixels' mean.

        By the corners of the windows of (height, width), where they fit.
        """
        height, width = size
        sums = np.pad(self._times.cumsum(0).cumsum(1), ((1, 0), (1, 0)))
        tall = sums[height:] - sums[: len(sums) - height]
        wide = tall[:, width:] - tall[:, : tall.shape[1] - width]
        return np.asarray(wide / (height * width * max(float(self._times.mean()), 1e-6)))
