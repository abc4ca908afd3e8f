"""The search for the nearest points, exact, in rows of pixels and at single places.

A row's pixels within one cell look at the points of that cell and those round it together, which is
fast; who may have nearer points beyond, looks again on his own, in wider and wider rings.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from worker.numba_kernel import kernel, parallel_kernel, prange

if TYPE_CHECKING:
    from numpy.typing import NDArray


class Points(NamedTuple):
    """Points by cell: those of cell c are starts[c] to starts[c + 1], places within it in 0..1.

    Cell (i, j, k), counted from the lower left corner of the first slice, is
    c = (k * frequency + j) * frequency + i; in a plane k is 0. Places are always (n, 3).
    """

    starts: NDArray[np.int64]
    places: NDArray[np.float64]


@parallel_kernel
def fill_distances(
    values: NDArray[np.float32],
    cells: tuple[NDArray[np.int64], ...],
    offsets: tuple[NDArray[np.float64], ...],
    points: Points,
    period: int,
    flat: bool,
    metric: int,
    output: int,
) -> None:
    """Write distances (depth, height, width) from cells and offsets along u, v and w.

    Metrics are 0 euclidean, 1 manhattan, 2 chebyshev; outputs 0 the nearest, 1 the second, 2 their
    difference.
    """
    depth, height, width = values.shape
    for line in prange(depth * height):
        away, row = line // height, line % height
        columns = cells[0]
        nearest = np.empty((2, width))
        start = 0
        while start < width:
            end = start + 1
            while end < width and columns[end] == columns[start]:
                end += 1
            _search_around(
                nearest[0, start:end],
                nearest[1, start:end],
                offsets[0][start:end],
                (columns[start], cells[1][row], cells[2][away]),
                (offsets[1][row], offsets[2][away]),
                points,
                period,
                flat,
                metric,
            )
            start = end
        for column in range(width):
            place = (offsets[0][column], offsets[1][row], offsets[2][away])
            first, second = nearest[0, column], nearest[1, column]
            reach = 1 + _margin(place, flat)
            enough = first if output == 0 else second
            if enough > (reach * reach if metric == 0 else reach):
                cell = (columns[column], cells[1][row], cells[2][away])
                first, second = _nearest(points, cell, place, period, flat, metric, output == 0)
            values[away, row, column] = _shown(first, second, metric, output)


@kernel
def _search_around(
    first: NDArray[np.float64],
    second: NDArray[np.float64],
    x: NDArray[np.float64],
    cell: tuple[int, int, int],
    offset: tuple[float, float],
    points: Points,
    period: int,
    flat: bool,
    metric: int,
) -> None:
    """Find the two smallest distances, to points of the cell and those round it, of a row in it."""
    first[:] = np.inf
    second[:] = np.inf
    y, z = offset
    left, low, near = cell[0] % period, cell[1] % period, cell[2] % period
    deep = 0 if flat else 1
    for k in range(-deep, deep + 1):
        layer = 0 if flat else _wrapped(near + k, period) * period
        for j in range(-1, 2):
            line = (layer + _wrapped(low + j, period)) * period
            for i in range(-1, 2):
                index = line + _wrapped(left + i, period)
                for point in range(points.starts[index], points.starts[index + 1]):
                    up = abs(j + points.places[point, 1] - y)
                    away = 0.0 if flat else abs(k + points.places[point, 2] - z)
                    place = i + points.places[point, 0]
                    if metric == 0:
                        _compare_squares(first, second, x, place, up * up, away * away)
                    else:
                        _compare(first, second, x, place, up, away, metric)


@kernel
def _compare_squares(
    first: NDArray[np.float64],
    second: NDArray[np.float64],
    x: NDArray[np.float64],
    place: float,
    up: float,
    away: float,
) -> None:
    # Twice over, since a loop that writes two arrays is not vectorised
    for n in range(len(x)):
        across = place - x[n]
        distance = across * across + up + away
        between = distance if distance > first[n] else first[n]
        second[n] = between if between < second[n] else second[n]
    for n in range(len(x)):
        across = place - x[n]
        distance = across * across + up + away
        first[n] = distance if distance < first[n] else first[n]


@kernel
def _compare(
    first: NDArray[np.float64],
    second: NDArray[np.float64],
    x: NDArray[np.float64],
    place: float,
    up: float,
    away: float,
    metric: int,
) -> None:
    for n in range(len(x)):
        across = abs(place - x[n])
        distance = across + up + away if metric == 1 else max(across, up, away)
        if distance < first[n]:
            first[n], second[n] = distance, first[n]
        elif distance < second[n]:
            second[n] = distance


@kernel
def fill_distances_at(
    values: NDArray[np.float64],
    places: NDArray[np.float64],
    points: Points,
    period: int,
    flat: bool,
    metric: int,
    output: int,
) -> None:
    """Write distances (n,) from places (n, 3) in cells."""
    for n in range(len(values)):
        i, j, k = np.floor(places[n, 0]), np.floor(places[n, 1]), np.floor(places[n, 2])
        first, second = _nearest(
            points,
            (int(i), int(j), int(k)),
            (places[n, 0] - i, places[n, 1] - j, places[n, 2] - k),
            period,
            flat,
            metric,
            output == 0,
        )
        values[n] = _shown(first, second, metric, output)


@kernel
def _margin(offset: tuple[float, float, float], flat: bool) -> float:
    """Return how far the nearest side of its cell is from a place."""
    x, y, z = offset
    margin = min(x, 1 - x, y, 1 - y)
    return margin if flat else min(margin, z, 1 - z)


@kernel
def _shown(first: float, second: float, metric: int, output: int) -> float:
    if metric == 0:
        first, second = np.sqrt(first), np.sqrt(second)
    return (first, second, second - first)[output]


@kernel
def _nearest(
    points: Points,
    cell: tuple[int, int, int],
    offset: tuple[float, float, float],
    period: int,
    flat: bool,
    metric: int,
    first_only: bool,
) -> tuple[float, float]:
    """Return the two smallest distances, squared if euclidean, from a place within a cell."""
    first = second = np.inf
    x, y, z = offset
    left, low, near = cell[0] % period, cell[1] % period, cell[2] % period
    margin = _margin(offset, flat)
    ring = 0
    while True:
        reach = ring - 1 + margin
        enough = first if first_only else second
        if ring > 0 and enough <= (reach * reach if metric == 0 else reach):
            return first, second
        deep = 0 if flat else ring
        for k in range(-deep, deep + 1):
            layer = 0 if flat else _wrapped(near + k, period) * period
            for j in range(-ring, ring + 1):
                line = (layer + _wrapped(low + j, period)) * period
                # What is within the ring or shell has cells at its two ends only
                whole = abs(j) == ring or (abs(k) == ring and not flat)
                for i in range(-ring, ring + 1, 1 if whole else max(2 * ring, 1)):
                    index = line + _wrapped(left + i, period)
                    for point in range(points.starts[index], points.starts[index + 1]):
                        across = abs(i + points.places[point, 0] - x)
                        up = abs(j + points.places[point, 1] - y)
                        away = 0.0 if flat else abs(k + points.places[point, 2] - z)
                        if metric == 0:
                            distance = across * across + up * up + away * away
                        elif metric == 1:
                            distance = across + up + away
                        else:
                            distance = max(across, up, away)
                        if distance < first:
                            first, second = distance, first
                        elif distance < second:
                            second = distance
        ring += 1


@kernel
def _wrapped(index: int, period: int) -> int:
    """Return index modulo period: of the few periods a ring goes beyond, faster than dividing."""
    while index < 0:
        index += period
    while index >= period:
        index -= period
    return index
