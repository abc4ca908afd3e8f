"""What texture optimisation begins with on its coarsest level."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from scipy import ndimage

from worker.synthesis._counter_hash import hashes

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from worker.synthesis.by_example.patch_grid import PatchGrid

    Bytes = NDArray[np.uint8]
    Mask = NDArray[np.bool_]
    Integers = NDArray[np.int64]


def random_blocks(
    grid: PatchGrid, limits: tuple[int, int], side: int, seed: int, use: int
) -> tuple[Integers, Integers]:
    """Return rows and columns of source patches: random blocks, so that structure is there at once.

    Args:
        grid: Of the target's patches.
        limits: How many rows and columns of patches the source has.
        side: Of a block, in pixels.
        seed: Of the random numbers.
        use: Another one, other blocks.
    """
    places = [np.arange(count) * grid.stride for count in grid.counts]
    across = int(places[1][-1]) // side + 1
    block = (places[0] // side)[:, np.newaxis] * across + places[1] // side
    chance = hashes(seed, use, int(block.max()) + 1)[block]
    found = []
    for axis, shift in ((0, 0), (1, 32)):
        inner = places[axis] % side
        room = max(1, limits[axis] - side + 1)
        bits = (chance >> np.uint64(shift)) & np.uint64(0xFFFFFFFF)
        start = ((bits * np.uint64(room)) >> np.uint64(32)).astype(np.int64)
        found.append(start + (inner[:, np.newaxis] if axis == 0 else inner))
    return found[0], found[1]


def brought_to(
    place: NDArray[np.int32], whole: tuple[int, int], source: tuple[int, int], grid: PatchGrid
) -> tuple[Integers, Integers]:
    """Return rows and columns of the source patches that a map of another size comes near to.

    Args:
        place: Rows and columns of the whole source, (height, width, 2).
        whole: Its height and width.
        source: The same of the source as it is on this level.
        grid: Of the target's patches.
    """
    middles = [
        (np.arange(count) * grid.stride + grid.side // 2 + 0.5) * length / size
        for count, length, size in zip(grid.counts, place.shape, grid.size, strict=False)
    ]
    rows, columns = (
        np.minimum(middle, length - 1).astype(np.int64)
        for middle, length in zip(middles, place.shape, strict=False)
    )
    there = place[rows[:, np.newaxis], columns]
    found = [
        np.round((there[..., axis] + 0.5) * source[axis] / whole[axis] - 0.5) - grid.side // 2
        for axis in (0, 1)
    ]
    return found[0].astype(np.int64), found[1].astype(np.int64)


def continued_outwards(features: Bytes, fixed: Mask) -> Bytes:
    """Return features in which each unknown pixel is like the nearest fixed one."""
    rows, columns = ndimage.distance_transform_edt(
        ~fixed, return_distances=False, return_indices=True
    )
    return np.asarray(features[rows, columns])
