"""Which corners and edges of triangles belong together."""

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Indices = NDArray[np.int64]


def weld(rows: Floats) -> Indices:
    """Number rows (n, k) so that equal rows have equal numbers, from 0."""
    plain = np.ascontiguousarray(rows + 0.0)  # minus zero is zero
    as_bytes = plain.view(np.dtype((np.void, plain.itemsize * plain.shape[1])))[:, 0]
    return np.unique(as_bytes, return_inverse=True)[1].astype(np.int64)


def following(corners: Indices) -> Indices:
    """Return the next corner of the same triangle; a corner is triangle * 3 + 0..2."""
    return corners - corners % 3 + (corners + 1) % 3


def shared_edges(welded: Indices, used: Indices) -> tuple[Indices, Indices]:
    """Pair edges that two triangles run along in opposite directions.

    Where more than two share one, the first in one direction is paired with the first in the other.

    Args:
        welded: (m, 3), numbers of the triangles' corners.
        used: Which triangles count.

    Returns:
        The corners at which the paired edges begin, as triangle * 3 + corner.
    """
    corners = (used[:, None] * 3 + np.arange(3)).ravel()
    start, end = welded.ravel()[corners], welded.ravel()[following(corners)]
    low, high = np.minimum(start, end), np.maximum(start, end)
    edge = np.unique(low * (welded.max() + 1) + high, return_inverse=True)[1]
    forward, backward = np.flatnonzero(start < end), np.flatnonzero(start > end)
    count = np.bincount(edge[forward], minlength=len(edge))
    first = np.cumsum(count) - count
    forward = forward[np.argsort(edge[forward], kind="stable")]
    backward = backward[np.argsort(edge[backward], kind="stable")]
    edges = edge[backward]
    rank = np.arange(len(edges)) - np.searchsorted(edges, edges)
    paired = rank < count[edges]
    partner = forward[first[edges[paired]] + rank[paired]]
    return corners[partner], corners[backward[paired]]


def sums(values: Floats, groups: Indices, count: int) -> Floats:
    """Add up rows (n, k) by their group, 0..count - 1; returns (count, k)."""
    added: Floats = np.stack(
        [np.bincount(groups, column, minlength=count) for column in values.T], axis=1
    )
    return added
