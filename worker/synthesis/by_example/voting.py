"""From patches to pixels: each pixel takes one of the source pixels its patches propose."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from worker.numba_kernel import kernel, parallel_kernel, prange

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from worker.synthesis.by_example.patch_grid import Cover

    Bytes = NDArray[np.uint8]
    Integers = NDArray[np.int32]


def vote(
    source: Bytes,
    field: tuple[Integers, Integers, Integers],
    covers: tuple[Cover, Cover],
    features: Bytes,
    place: Integers,
    fixed: NDArray[np.bool_],
    anew: NDArray[np.bool_],
) -> NDArray[np.bool_]:
    """Let patches choose the pixels anew, in place; return which pixels changed.

    Every patch proposes its source pixel, the more strongly the better it fits: by one over the
    root of its cost (near to Kwatra et al., 2005, and equal on every processor). Of the proposals
    the one nearest to their weighted mean is taken, so nothing is blurred; what many propose is
    preferred.

    Args:
        source: Features of the source, (height, width, channels).
        field: The source patch of every target patch, and costs.
        covers: Of rows and of columns.
        features: Of the target; more channels than the source has are left alone.
        place: Row and column of the source pixel of every target pixel, (height, width, 2).
        fixed: Pixels that stay, (height, width).
        anew: Patches that are not as they were at the last vote; only their pixels choose.
    """
    rows, columns, costs = field
    weights = np.empty(costs.shape, np.float32)
    _weigh(costs, weights)
    changed = np.zeros(fixed.shape, np.bool_)
    _vote(
        source,
        rows,
        columns,
        weights,
        *covers[0],
        *covers[1],
        features,
        place,
        fixed,
        anew,
        changed,
    )
    return changed


@parallel_kernel
def _weigh(costs: Integers, weights: NDArray[np.float32]) -> None:
    for y in prange(costs.shape[0]):
        for x in range(costs.shape[1]):
            weights[y, x] = np.float32(1) / np.sqrt(np.float32(costs[y, x]) + np.float32(1))


@parallel_kernel
def _vote(
    source: Bytes,
    rows: Integers,
    columns: Integers,
    weights: NDArray[np.float32],
    row_patches: Integers,
    row_inner: Integers,
    column_patches: Integers,
    column_inner: Integers,
    features: Bytes,
    place: Integers,
    fixed: NDArray[np.bool_],
    anew: NDArray[np.bool_],
    changed: NDArray[np.bool_],
) -> None:
    height, width = fixed.shape
    channels = source.shape[2]
    across, down = column_patches.shape[1], row_patches.shape[1]
    slots = 2
    while slots < 2 * across * down:
        slots *= 2
    for y in prange(height):
        # A hash table of the proposals of one pixel: of the number it has, and of whose it is
        known_as = np.empty(slots, np.int32)
        known_by = np.full(slots, -1, np.int32)
        mean = np.empty(channels, np.float32)
        vs = np.empty(across * down, np.int32)
        us = np.empty(across * down, np.int32)
        shares = np.empty(across * down, np.float32)
        for x in range(width):
            if fixed[y, x] or not _held(anew, row_patches[y], column_patches[x]):
                continue
            count, known, known_v, known_u = 0, 0, -1, -1
            for j in range(down):
                patch_y = row_patches[y, j]
                if patch_y < 0:
                    break
                for i in range(across):
                    patch_x = column_patches[x, i]
                    if patch_x < 0:
                        break
                    v = rows[patch_y, patch_x] + row_inner[y, j]
                    u = columns[patch_y, patch_x] + column_inner[x, i]
                    # Neighbours mostly propose the same
                    if v != known_v or u != known_u:
                        known_v, known_u = v, u
                        slot = (v * 73856093 ^ u * 19349663) & (slots - 1)
                        while known_by[slot] == x and (
                            vs[known_as[slot]] != v or us[known_as[slot]] != u
                        ):
                            slot = (slot + 1) & (slots - 1)
                        if known_by[slot] != x:
                            known_by[slot], known_as[slot] = x, count
                            vs[count], us[count], shares[count] = v, u, np.float32(0)
                            count += 1
                        known = known_as[slot]
                    shares[known] += weights[patch_y, patch_x]
            if count == 0:
                continue
            best = 0
            if count > 1:
                best = _nearest_to_mean(source, vs, us, shares, count, mean)
            v, u = vs[best], us[best]
            if place[y, x, 0] != v or place[y, x, 1] != u:
                place[y, x, 0], place[y, x, 1] = v, u
                for channel in range(channels):
                    if features[y, x, channel] != source[v, u, channel]:
                        features[y, x, channel] = source[v, u, channel]
                        changed[y, x] = True


@kernel
def _held(anew: NDArray[np.bool_], rows: Integers, columns: Integers) -> bool:
    """Return whether any of the patches that hold a pixel is new."""
    for y in rows:
        for x in columns:
            if y >= 0 and x >= 0 and anew[y, x]:
                return True
    return False


@kernel
def _nearest_to_mean(
    source: Bytes,
    vs: Integers,
    us: Integers,
    shares: NDArray[np.float32],
    count: int,
    mean: NDArray[np.float32],
) -> int:
    """Return which of the source pixels is nearest to their weighted mean."""
    total = np.float32(0)
    mean[:] = 0
    for k in range(count):
        total += shares[k]
        for channel in range(len(mean)):
            mean[channel] += shares[k] * np.float32(source[vs[k], us[k], channel])
    best, nearest = 0, np.float32(np.inf)
    for k in range(count):
        distance = np.float32(0)
        for channel in range(len(mean)):
            step = np.float32(source[vs[k], us[k], channel]) - mean[channel] / total
            distance += step * step
        distance *= np.float32(1) - np.float32(0.5) * shares[k] / total
        if distance < nearest:
            best, nearest = k, distance
    return best
