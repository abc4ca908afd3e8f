"""How the samples round a pixel's middle are weighed, along each axis alike."""

import numpy as np
from numpy.typing import NDArray

from api_schemas.output import PixelFilter

_STEEPNESS = 2.0
"""Of exp(-2 d^2), d in pixels: a standard deviation of half a pixel."""


def apron(pixel_filter: PixelFilter) -> int:
    """Return how many pixels beyond its own a pixel's samples lie in."""
    return 0 if pixel_filter == "box" else 1


def weights(pixel_filter: PixelFilter, samples_per_side: int) -> NDArray[np.float64]:
    """Return the weights of all samples that lie in a pixel and its neighbours; they add up to 1.

    A tent falls from the pixel's middle to those of its neighbours, a Gaussian is cut where the
    neighbours end.
    """
    across = (2 * apron(pixel_filter) + 1) * samples_per_side
    distance = (np.arange(across) + 0.5) / samples_per_side - across / samples_per_side / 2
    match pixel_filter:
        case "box":
            found = np.ones(across)
        case "tent":
            found = np.clip(1 - np.abs(distance), 0, None)
        case "gaussian":
            found = np.exp(-_STEEPNESS * distance**2)
    shares: NDArray[np.float64] = found / found.sum()
    return shares
