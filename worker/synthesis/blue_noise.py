"""Blue noise by void and cluster (Ulichney, 1993).

Points are set one by one where there is the largest void, measured by the sum of a bell around each
point that is set; those of the first pattern are ranked by taking the tightest clusters away. The
rank of a point is its value.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from worker.images.image import Image
from worker.numba_kernel import kernel
from worker.synthesis._counter_hash import hashes

if TYPE_CHECKING:
    from collections.abc import Mapping

    from numpy.typing import NDArray

    from api_schemas.textures.blue_noise import BlueNoiseSpec
    from worker.stages import Report

    Numbers = NDArray[np.float64]

_DEVIATION = 1.5
_RADIUS = 7
"""Beyond, the bell is below a hundred-thousandth of its top."""
_SHARE_AT_FIRST = 0.1


def synthesize(
    spec: BlueNoiseSpec, size: tuple[int, int], inputs: Mapping[str, Image], report: Report
) -> Image:
    """Repeat the tile over (width, height): one channel of data."""
    width, height = size
    tile = ((ranks(spec.side, spec.seed) + 0.5) / spec.side**2).astype(np.float32)
    rows, columns = np.arange(height) % spec.side, np.arange(width) % spec.side
    return Image(np.ascontiguousarray(tile[np.ix_(rows, columns)])[..., np.newaxis], spec.meaning)


def ranks(side: int, seed: int) -> NDArray[np.int64]:
    """Return the order in which the points of a tile are set, (side, side)."""
    first = np.argsort(hashes(seed, 0, side * side), kind="stable")
    found = np.empty((side, side), np.int64)
    distances = np.arange(-_RADIUS, _RADIUS + 1) ** 2
    bell = np.exp(-np.add.outer(distances, distances) / (2 * _DEVIATION**2))
    _rank(found, first[: int(_SHARE_AT_FIRST * side * side)], bell)
    return found


def warm() -> None:
    """Compile the kernels."""
    ranks(16, 0)


@kernel
def _rank(found: NDArray[np.int64], first: NDArray[np.int64], bell: Numbers) -> None:
    side = len(found)
    count = len(first)
    energy = np.zeros((side, side))
    filled = np.zeros((side, side), np.bool_)
    # Of each row the column of the tightest cluster and of the largest void, and how much they have
    best = np.zeros((2, side), np.int64)
    most = np.full((2, side), -np.inf)
    for place in first:
        _change(filled, energy, best, most, bell, place // side, place % side)
    for row in range(side):
        _look(filled, energy, best, most, row)
    for _ in range(side * side):  # it ends when the tightest cluster is the largest void
        row = int(np.argmax(most[0]))
        column = best[0, row]
        _change(filled, energy, best, most, bell, row, column)
        void = int(np.argmax(most[1]))
        hole = best[1, void]
        _change(filled, energy, best, most, bell, void, hole)
        if void == row and hole == column:
            break
    start, start_energy = filled.copy(), energy.copy()
    for rank in range(count - 1, -1, -1):
        row = int(np.argmax(most[0]))
        found[row, best[0, row]] = rank
        _change(filled, energy, best, most, bell, row, best[0, row])
    filled[:], energy[:] = start, start_energy
    for row in range(side):
        _look(filled, energy, best, most, row)
    for rank in range(count, side * side):
        row = int(np.argmax(most[1]))
        found[row, best[1, row]] = rank
        _change(filled, energy, best, most, bell, row, best[1, row])


@kernel
def _change(
    filled: NDArray[np.bool_],
    energy: Numbers,
    best: NDArray[np.int64],
    most: Numbers,
    bell: Numbers,
    row: int,
    column: int,
) -> None:
    """Set a point or take it away, and look again at the rows that feel it."""
    side = len(filled)
    sign = -1.0 if filled[row, column] else 1.0
    filled[row, column] = not filled[row, column]
    for y in range(-_RADIUS, _RADIUS + 1):
        near = (row + y) % side
        for x in range(-_RADIUS, _RADIUS + 1):
            energy[near, (column + x) % side] += sign * bell[y + _RADIUS, x + _RADIUS]
    for y in range(-_RADIUS, _RADIUS + 1):
        _look(filled, energy, best, most, (row + y) % side)


@kernel
def _look(
    filled: NDArray[np.bool_],
    energy: Numbers,
    best: NDArray[np.int64],
    most: Numbers,
    row: int,
) -> None:
    most[0, row] = most[1, row] = -np.inf
    for column in range(len(filled)):
        kind = 0 if filled[row, column] else 1
        amount = energy[row, column] if kind == 0 else -energy[row, column]
        if amount > most[kind, row]:
            most[kind, row] = amount
            best[kind, row] = column
