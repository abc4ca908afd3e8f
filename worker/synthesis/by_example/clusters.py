"""The neighbourhoods of an exemplar sorted into clusters (Popat and Picard, 1993).

A pixel's surroundings are compared with the clusters first: each is a Gaussian around its mean
neighbourhood, as likely as it is large. Only the members of the likeliest are compared one by one.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view

from worker.numba_kernel import kernel
from worker.synthesis._counter_hash import uniforms
from worker.synthesis.by_example.hashing import below, scrambled
from worker.synthesis.by_example.surroundings import known_around

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from worker.synthesis.by_example.arrays import Bytes, Integers, Mask, Numbers


_ROUNDS = 8
_SAMPLES = 8192
_BLOCK = 4096
_USE_OF_STARTS = 2**31


class Clusters(NamedTuple):
    """Places of an exemplar by what is around them.

    Attributes:
        means: Mean neighbourhoods, (clusters, window, window, channels).
        variance: Of a number of a neighbourhood around its mean, the same for all: narrow
            Gaussians of their own would draw everything into what is even.
        shares: How many of all places are members, 0..1.
        members: Places as row x width + column, one cluster behind the other.
        starts: Where each cluster begins among them, and the end, (clusters + 1,).
    """

    means: Bytes
    variance: float
    shares: Numbers
    members: NDArray[np.int64]
    starts: NDArray[np.int64]

    @classmethod
    def of(cls, features: Bytes, allowed: Mask, reach: int, count: int, seed: int) -> Clusters:
        """Sort the places that are allowed into at most `count` clusters, by k-means.

        Args:
            features: Of the exemplar, (height, width, channels).
            allowed: Middles of neighbourhoods that lie within it, (height, width); at least one.
            reach: Pixels from the middle to the edge of a neighbourhood.
            count: How many clusters there are at most.
            seed: Of the random numbers.
        """
        side = 2 * reach + 1
        windows = sliding_window_view(features, (side, side), (0, 1)).transpose(0, 1, 3, 4, 2)
        places = np.flatnonzero(allowed)
        rows, columns = (part - reach for part in np.divmod(places, allowed.shape[1]))
        sample = np.linspace(0, len(places) - 1, min(_SAMPLES, len(places))).astype(np.int64)
        some = windows[rows[sample], columns[sample]].reshape(len(sample), -1).astype(np.float64)
        chances = uniforms(seed, _USE_OF_STARTS, min(count, len(some)))
        means = np.unique(some[(chances * len(some)).astype(np.int64)], axis=0)
        for _ in range(_ROUNDS):
            nearest, _ = _nearest(some, means)
            sizes = np.bincount(nearest, minlength=len(means))
            sums = np.zeros_like(means)
            np.add.at(sums, nearest, some)
            means = np.rint(sums[sizes > 0] / sizes[sizes > 0, np.newaxis])
        cluster = np.empty(len(places), np.int64)
        squares = np.empty(len(places))
        for start in range(0, len(places), _BLOCK):
            part = np.s_[start : start + _BLOCK]
            block = windows[rows[part], columns[part]].reshape(-1, means.shape[1])
            cluster[part], squares[part] = _nearest(block.astype(np.float64), means)
        sizes = np.bincount(cluster, minlength=len(means))
        full = sizes > 0
        order = cluster.argsort(kind="stable")
        return cls(
            means[full].astype(np.uint8).reshape(-1, side, side, features.shape[2]),
            # Where all are like their means, a step of 8 bits is the least there is
            max(1.0, float(squares.mean()) / means.shape[1]),
            sizes[full] / len(places),
            places[order],
            np.concatenate([[0], np.cumsum(sizes[full])]),
        )


def _nearest(points: Numbers, means: Numbers) -> tuple[NDArray[np.int64], Numbers]:
    """Return the nearest mean of each point, and its squared distance: whole numbers are exact."""
    scores = (means**2).sum(axis=1) - 2 * (points @ means.T)
    nearest = scores.argmin(axis=1)
    squares = np.take_along_axis(scores, nearest[:, np.newaxis], axis=1)[:, 0]
    return nearest, squares + (points**2).sum(axis=1)


@kernel
def visit_clusters(
    pixels: NDArray[np.int64],
    place: Integers,
    known: Mask,
    target: Bytes,
    features: Bytes,
    clusters: Clusters,
    weights: Integers,
    bound: float,
    wraps: bool,
    key: np.uint64,
) -> int:
    """Choose pixels one after the other; return how many of them found something good enough."""
    width = known.shape[1]
    wide, channels = features.shape[1], features.shape[2]
    means, variance, shares, members, starts = clusters
    reach = len(weights) // 2
    differences = np.empty(len(members), np.int64)
    placed = 0
    for pixel in pixels:
        y, x = pixel // width, pixel % width
        steps, near, values = known_around(known, target, weights, (y, x), wraps)
        count, total = len(near), near.sum()
        likeliest, best = 0, np.inf
        for cluster in range(len(means)):
            squares = np.int64(0)
            for i in range(count):
                for channel in range(channels):
                    mean = means[cluster, reach + steps[i, 0], reach + steps[i, 1], channel]
                    squares += (values[i, channel] - np.int64(mean)) ** 2
            # Twice the negative logarithm of the Gaussian's density times its share
            unlikely = squares / variance - 2 * np.log(shares[cluster])
            if unlikely < best:
                likeliest, best = cluster, unlikely
        first, last = starts[likeliest], starts[likeliest + 1]
        least = np.int64(2**62)
        for member in range(first, last):
            v, u = members[member] // wide, members[member] % wide
            squares = np.int64(0)
            for i in range(count):
                down, right = steps[i]
                for channel in range(channels):
                    step = values[i, channel] - features[v + down, u + right, channel]
                    squares += near[i] * step * step
            differences[member] = squares
            least = min(least, squares)
        if total > 0 and least > bound * (65025.0 * channels) * total:
            continue
        limit = np.int64(np.floor(least * 1.1))
        alike = 0
        for member in range(first, last):
            alike += differences[member] <= limit
        chosen = below(scrambled(key, pixel), alike)
        for member in range(first, last):
            if differences[member] <= limit:
                if chosen == 0:
                    place[y, x] = members[member]
                    v, u = members[member] // wide, members[member] % wide
                    for channel in range(channels):
                        target[y, x, channel] = features[v, u, channel]
                chosen -= 1
        known[y, x] = True
        placed += 1
    return placed
