"""Numbers that are none, before they spread: a filter would make one bad texel many."""

import numpy as np
from numpy.typing import NDArray


def mended(pixels: NDArray[np.float32]) -> tuple[NDArray[np.float32], int]:
    """Return light that is finite and not negative, and how many numbers were not finite.

    What is no number is dark, and what is infinite as bright as the brightest that is not.
    """
    fit = np.isfinite(pixels)
    count = int(fit.size - np.count_nonzero(fit))
    if count:
        brightest = pixels.max(initial=0.0, where=fit)
        pixels = np.nan_to_num(pixels, nan=0.0, posinf=brightest, neginf=0.0)
    return np.maximum(pixels, np.float32(0)), count
