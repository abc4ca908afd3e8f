"""Holes in a picture, filled from what is round them."""

import numpy as np
from numpy.typing import NDArray


def spread(pixels: NDArray[np.float32], valid: NDArray[np.bool_]) -> NDArray[np.float32]:
    """Fill holes with the means of what is near: from 2 x 2 blocks, and theirs, and so on.

    Pull and push of Gortler et al., 1996, without smoothing.

    Args:
        pixels: float32 (height, width, channels).
        valid: bool (height, width), False in the holes.
    """
    if valid.all() or not valid.any():
        return pixels
    height, width, channels = pixels.shape
    even = ((0, height % 2), (0, width % 2))
    weights = np.pad(valid, even).astype(np.float32)[..., np.newaxis]
    held = np.pad(np.where(valid[..., np.newaxis], pixels, np.float32(0)), (*even, (0, 0)))
    rows, columns = weights.shape[0] // 2, weights.shape[1] // 2
    sums = held.reshape(rows, 2, columns, 2, channels).sum(axis=(1, 3))
    counts = weights.reshape(rows, 2, columns, 2, 1).sum(axis=(1, 3))
    coarse = spread(sums / np.maximum(counts, 1), counts[..., 0] > 0)
    near = coarse.repeat(2, axis=0).repeat(2, axis=1)[:height, :width]
    return np.where(valid[..., np.newaxis], pixels, near)
