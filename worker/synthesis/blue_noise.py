"""Blue noise by void and cluster (Ulichney, 1993).

Points are set one by one where there is the largest void, measured by the sum of a bell around each
point that is set; those of the first pattern are ranked by taking the tightest clusters away. The
rank of a point is its value.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

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


class Pattern(NamedTuple):
    """Points that are set on a tile.

    Attributes:
        filled: Where they are, (side, side).
        energy: The sum of the bells around them.
        best: Of each row the column of the tightest cluster and of the largest void, (2, side).
        most: How tight and how void these are; a row without points is void alike everywhere.
    """

    filled: NDArray[np.bool_]
    energy: Numbers
    best: NDArray[np.int64]
    most: Numbers

    def copied(self) -> Pattern:
        """Return the same in arrays of its own."""
        return Pattern(self.filled.copy(), self.energy.copy(), self.best.copy(), self.most.copy())


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
    distances = np.arange(-_RADIUS, _RADIUS + 1) ** 2
    bell = np.exp(-np.add.outer(distances, distances) / (2 * _DEVIATION**2))
    pattern = Pattern(
        np.zeros((side, side), np.bool_),
        np.zeros((side, side)),
        np.zeros((2, side), np.int64),
        np.zeros((2, side)),
    )
    count = int(_SHARE_AT_FIRST * side * side)
    picked = np.empty(2 * side * side, np.int64)
    _place(pattern, first[:count], bell)
    _pick(pattern, np.arange(2 * side * side) % 2, picked, bell)
    found = np.empty(side * side, np.int64)
    emptied = pattern.copied()
    _pick(emptied, np.zeros(count, np.int64), picked, bell)
    found[picked[:count]] = np.arange(count)[::-1]
    rest = side * side - count
    _pick(pattern, np.ones(rest, np.int64), picked, bell)
    found[picked[:rest]] = np.arange(count, side * side)
    return found.reshape(side, side)


def warm() -> None:
    """Compile the kernels."""
    ranks(16, 0)


@kernel
def _place(pattern: Pattern, places: NDArray[np.int64], bell: Numbers) -> None:
    """Set the points at places given."""
    side = len(pattern.filled)
    for place in places:
        _change(pattern, bell, place // side, place % side)


@kernel
def _pick(
    pattern: Pattern, kinds: NDArray[np.int64], picked: NDArray[np.int64], bell: Numbers
) -> int:
    """Take away the tightest cluster (kind 0) or fill the largest void (1), one after the other.

    Returns:
        How many were picked: it ends early once what was taken away is what would be filled.
    """
    side = len(pattern.filled)
    for turn, kind in enumerate(kinds):
        row = int(np.argmax(pattern.most[kind]))
        column = pattern.best[kind, row]
        picked[turn] = row * side + column
        _change(pattern, bell, row, column)
        if turn and kind == 1 and kinds[turn - 1] == 0 and picked[turn] == picked[turn - 1]:
            return turn + 1
    return len(kinds)


@kernel
def _change(pattern: Pattern, bell: Numbers, row: int, column: int) -> None:
    """Set a point or take it away, and look again at the rows that feel it."""
    filled, energy = pattern.filled, pattern.energy
    side = len(filled)
    sign = -1.0 if filled[row, column] else 1.0
    filled[row, column] = not filled[row, column]
    for y in range(-_RADIUS, _RADIUS + 1):
        near = (row + y) % side
        for x in range(-_RADIUS, _RADIUS + 1):
            energy[near, (column + x) % side] += sign * bell[y + _RADIUS, x + _RADIUS]
    for y in range(-_RADIUS, _RADIUS + 1):
        near = (row + y) % side
        pattern.most[:, near] = -np.inf
        for x in range(side):
            kind = 0 if filled[near, x] else 1
            amount = energy[near, x] if kind == 0 else -energy[near, x]
            if amount > pattern.most[kind, near]:
                pattern.most[kind, near] = amount
                pattern.best[kind, near] = x
