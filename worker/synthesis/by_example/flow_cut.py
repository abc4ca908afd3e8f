"""The best of all ways to show one of two things at each pixel, by the largest flow.

Two things lie over each other, an old and a new one. What each pair of neighbours costs depends on
which of the two each shows. If a mixed pair costs together at least what two equal ones do, the
cheapest of all choices is a smallest cut of a graph, and there are no others as good by chance: of
equal cuts the one that shows most of the new is taken (Kolmogorov and Zabih, 2004).
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from scipy.sparse import coo_array, csr_array
from scipy.sparse.csgraph import breadth_first_order, maximum_flow

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Mask = NDArray[np.bool_]
    Integers = NDArray[np.int64]

_NEVER = 2**30


class Pairs(NamedTuple):
    """Pairs of neighbours and what they cost, (pairs,) each; two new ones cost nothing.

    Attributes:
        first: Number of a pixel.
        second: Number of another one.
        both_old: The cost if both show the old.
        new_second: The cost if the second alone shows the new; with `new_first` it is at least
            `both_old`.
        new_first: The cost if the first alone does.
    """

    first: Integers
    second: Integers
    both_old: Integers
    new_second: Integers
    new_first: Integers


def least_cut(pairs: Pairs, stays_old: Mask, stays_new: Mask) -> Mask:
    """Return which pixels show the new, (pixels,), so that all pairs together cost least.

    Args:
        pairs: Whose costs add up to less than 2^30.
        stays_old: Pixels that have no choice, (pixels,).
        stays_new: Others that have none.
    """
    count = len(stays_old)
    if not (~stays_old & ~stays_new).any():
        return stays_new.copy()
    # What it costs each pixel to be new, and each first one to be old beside a new second one
    alone = np.zeros(count, np.int64)
    np.add.at(alone, pairs.first, pairs.new_first - pairs.both_old)
    np.add.at(alone, pairs.second, -pairs.new_first)
    alone[stays_old], alone[stays_new] = _NEVER, -_NEVER
    between = pairs.new_second + pairs.new_first - pairs.both_old
    old, new = np.flatnonzero(alone > 0), np.flatnonzero(alone < 0)
    graph = _graph(
        np.concatenate([pairs.first, np.full(len(old), count), new]),
        np.concatenate([pairs.second, old, np.full(len(new), count + 1)]),
        np.concatenate([between, alone[old], -alone[new]]),
        count + 2,
    )
    flow = maximum_flow(graph, count, count + 1).flow
    left = (graph - flow).tocoo()
    open_ = left.data > 0
    reached = breadth_first_order(
        _graph(left.coords[0][open_], left.coords[1][open_], left.data[open_], count + 2),
        count,
        return_predecessors=False,
    )
    shown = np.ones(count + 2, bool)
    shown[reached] = False
    return shown[:count]


def _graph(
    starts: NDArray[np.integer],
    ends: NDArray[np.integer],
    capacities: NDArray[np.integer],
    count: int,
) -> csr_array:
    edges = (starts.astype(np.int32), ends.astype(np.int32))
    whole = coo_array((capacities.astype(np.int32), edges), shape=(count, count))
    return csr_array(whole)
