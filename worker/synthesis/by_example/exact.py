"""The nearest of all patches, by matrix products.

Squared differences of bytes are whole numbers, and |p - q|^2 - |p|^2 = |q|^2 - 2 p.q stays below
2^24 for up to 258 numbers a patch: there float32 is exact, in whatever order it is summed.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view

from worker.synthesis.by_example.windows import whole_windows

if TYPE_CHECKING:
    from collections.abc import Iterator

    from numpy.typing import NDArray

    Bytes = NDArray[np.uint8]
    Mask = NDArray[np.bool_]

_BLOCK = 8192


def nearest_distances(
    ours: Bytes, chosen: NDArray[np.int64], theirs: Bytes, usable: Mask, side: int
) -> NDArray[np.float32]:
    """Return the smallest squared difference of each chosen patch of ours to any of theirs.

    Args:
        ours: Features, (height, width, channels).
        chosen: Upper left corners among all places where a patch of ours fits, row by row.
        theirs: Features, (height, width, channels).
        usable: Which of their pixels a patch may hold.
        side: Of a patch, in pixels.
    """
    return nearest_patches(ours, chosen, theirs, usable, side)[0]


def nearest_patches(
    ours: Bytes, chosen: NDArray[np.int64], theirs: Bytes, usable: Mask, side: int
) -> tuple[NDArray[np.float32], NDArray[np.int64]]:
    """Return the smallest squared differences, and the corner of the first patch that has it.

    Corners are numbered row by row among all places where a patch of theirs fits.
    """
    queries = _patches(ours, side, chosen)
    best = np.full(len(queries), np.inf, np.float32)
    place = np.zeros(len(queries), np.int64)
    corners = np.flatnonzero(whole_windows(usable, (side, side)))
    for block in _blocks(corners):
        others = _patches(theirs, side, block)
        scores = np.einsum("ij,ij->i", others, others) - 2 * (queries @ others.T)
        nearest = scores.argmin(axis=1)
        score = np.take_along_axis(scores, nearest[:, np.newaxis], axis=1)[:, 0]
        better = score < best
        best[better] = score[better]
        place[better] = block[nearest[better]]
    return best + np.einsum("ij,ij->i", queries, queries), place


def nearest_several(
    ours: Bytes, chosen: NDArray[np.int64], theirs: Bytes, usable: Mask, side: int, count: int
) -> tuple[NDArray[np.float32], NDArray[np.int64]]:
    """Return the smallest squared differences and their corners, (chosen, count), in order.

    Of equal ones those come first that are first row by row. Where less than so many patches of
    theirs fit, the others are infinitely far, at the corner of the nearest.
    """
    queries = _patches(ours, side, chosen)
    best = np.full((len(queries), count), np.inf, np.float32)
    place = np.zeros((len(queries), count), np.int64)
    corners = np.flatnonzero(whole_windows(usable, (side, side)))
    for block in _blocks(corners):
        others = _patches(theirs, side, block)
        scores = np.einsum("ij,ij->i", others, others) - 2 * (queries @ others.T)
        found, places = [best], [place]
        for _ in range(min(count, len(block))):
            nearest = scores.argmin(axis=1)[:, np.newaxis]
            found.append(np.take_along_axis(scores, nearest, axis=1))
            places.append(block[nearest])
            np.put_along_axis(scores, nearest, np.inf, axis=1)
        scored, there = np.concatenate(found, axis=1), np.concatenate(places, axis=1)
        order = scored.argsort(axis=1, kind="stable")[:, :count]
        best = np.take_along_axis(scored, order, axis=1)
        place = np.take_along_axis(there, order, axis=1)
    place = np.where(np.isinf(best), place[:, :1], place)
    return best + np.einsum("ij,ij->i", queries, queries)[:, np.newaxis], place


def _blocks(corners: NDArray[np.int64]) -> Iterator[NDArray[np.int64]]:
    for start in range(0, len(corners), _BLOCK):
        yield corners[start : start + _BLOCK]


def _patches(features: Bytes, side: int, corners: NDArray[np.int64]) -> NDArray[np.float32]:
    """Return patches at corners as lines of numbers, (patches, side x side x channels)."""
    windows = sliding_window_view(features, (side, side), (0, 1))
    rows, columns = np.divmod(corners, windows.shape[1])
    return windows[rows, columns].reshape(len(corners), -1).astype(np.float32)
