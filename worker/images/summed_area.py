"""Sums of all that lies to the left and below: four of them give the mean of any rectangle."""

import numpy as np
from numpy.typing import NDArray

from api_schemas.families import Wrap
from worker.images.ripmap import beyond


def summed_area_table(
    pixels: NDArray[np.float32], wrap: tuple[Wrap, Wrap], border: tuple[float, ...]
) -> NDArray[np.float32]:
    """Sum a picture up for sample_summed_area.glsl (Crow, 1984).

    S(x, y) is the sum of the x y texels at the lower left, each without the picture's mean, lest
    sums grow beyond what float32 tells apart. Two floats hold each sum: of a white half and a
    black one, 1024 x 1024, one float would be off by a hundredth.

    A mirrored axis holds its picture twice, the second time mirrored; one that is clamped or has a
    border holds one more texel at each end.

    Args:
        pixels: float32 (H, W, C), the uppermost row first.
        wrap: What lies beyond the edges along u and v.
        border: What lies there where that is a border.

    Returns:
        float32 (2 (h + 1), w + 2, C), the uppermost row first, of a picture of w x h texels: at
        the bottom the rows y = 0..h of S, rounded, above them the rest; on the right of the
        lowest row the mean.
    """
    texels = pixels[::-1]
    for axis, mode in ((1, wrap[0]), (0, wrap[1])):
        if mode == "mirror":
            texels = np.concatenate([texels, np.flip(texels, axis)], axis)
        elif mode != "repeat":
            texels = beyond(texels, axis, mode, border)
    height, width, channels = texels.shape
    mean = texels.mean((0, 1), dtype=np.float64).astype(np.float32)
    sums = np.zeros((height + 1, width + 1, channels))
    np.cumsum(texels - mean.astype(np.float64), axis=0, out=sums[1:, 1:])
    np.cumsum(sums, axis=1, out=sums)
    table = np.zeros((2, height + 1, width + 2, channels), np.float32)
    table[0, :, :-1] = sums
    table[1, :, :-1] = sums - table[0, :, :-1]
    table[0, 0, -1] = mean
    return table.reshape(2 * (height + 1), width + 2, channels)[::-1]
