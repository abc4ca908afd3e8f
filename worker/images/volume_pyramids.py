"""Mip chains of volumes: every level is the box mean of the one before (Williams 1983)."""

import numpy as np
from numpy.typing import NDArray


def volume_chain(voxels: NDArray[np.float32]) -> list[NDArray[np.float32]]:
    """Give a volume and its box means down to one voxel.

    Args:
        voxels: float32, shape (depth, height, width, channels), linear light, alpha premultiplied;
            sides are powers of two, and level 0 is this array.
    """
    levels = [voxels]
    while max(levels[-1].shape[:3]) > 1:
        level = levels[-1]
        for axis in range(3):
            level = _halved(level, axis)
        levels.append(level)
    return levels


def _halved(voxels: NDArray[np.float32], axis: int) -> NDArray[np.float32]:
    length = voxels.shape[axis]
    if length == 1:
        return voxels
    if length % 2:
        raise ValueError(f"a side of {length} voxels is no power of two")
    even = voxels.take(range(0, length, 2), axis)
    odd = voxels.take(range(1, length, 2), axis)
    return np.asarray((even + odd) * np.float32(0.5))
