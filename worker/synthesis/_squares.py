"""Light added up for squares of a picture's pixels, which choose their pieces together (T35).

What takes the time is the weight of a piece for a direction: sixteen directions have it worked out
side by side, for the pieces that the nearest of them asks for.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from worker.numba_kernel import kernel, parallel_kernel, prange
from worker.synthesis._lobes import PHONG, phong, value
from worker.synthesis._pieces import add_up, fill_near, next_piece, pieces, sizes

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from worker.synthesis._lobes import Lobe
    from worker.synthesis._pieces import Pieces

    Floats = NDArray[np.float64]

_SIDE = 4
_PIXELS = _SIDE * _SIDE
_WIDEST = 1.5  # widths of the lobe; what spreads farther is added up pixel by pixel


def sums(light: Pieces, lobe: Lobe, directions: Floats) -> NDArray[np.float32]:
    """Return the mean light (height, width, 3) in a lobe round the unit direction of each pixel."""
    height, width = directions.shape[:2]
    found = np.empty((height, width, 3), np.float32)
    size, reach = sizes(light, lobe)
    widest = _WIDEST * lobe.width
    _sum_squares(found, light, lobe.kind, lobe.sharpness, size, reach, directions, widest)
    return found


def warm() -> None:
    """Compile the kernels."""
    sums(pieces(np.zeros((6, 2, 2, 3), np.float32)), phong(1.0), np.eye(3)[np.newaxis])


@parallel_kernel
def _sum_squares(
    found: NDArray[np.float32],
    light: Pieces,
    kind: int,
    sharpness: float,
    size: Floats,
    reach: Floats,
    directions: Floats,
    widest: float,
) -> None:
    height, width = directions.shape[:2]
    across = (width + _SIDE - 1) // _SIDE
    for square in prange((height + _SIDE - 1) // _SIDE * across):
        top, left = square // across * _SIDE, square % across * _SIDE
        ways, totals = np.empty((3, _PIXELS)), np.zeros((4, _PIXELS))
        stack, near = np.empty((64, 3), np.int64), np.empty(len(size))
        middle = np.empty(3)
        # Beyond the picture's edge its last pixels stand in.
        for pixel in range(_PIXELS):
            row = min(top + pixel // _SIDE, height - 1)
            column = min(left + pixel % _SIDE, width - 1)
            for axis in range(3):
                ways[axis, pixel] = directions[row, column, axis]
        spread = _middle_of(middle, ways)
        fill_near(near, reach, spread if spread <= widest else 0.0)
        if spread <= widest:
            _sum_square(totals, stack, light, kind, sharpness, size, near, ways, middle, spread)
        else:
            total = np.empty(4)
            for pixel in range(_PIXELS):
                total[:] = 0.0
                add_up(total, stack, light, kind, sharpness, size, near, ways[:, pixel].copy())
                totals[:, pixel] = total
        for pixel in range(_PIXELS):
            row, column = top + pixel // _SIDE, left + pixel % _SIDE
            if row < height and column < width:
                for channel in range(3):
                    found[row, column, channel] = totals[1 + channel, pixel] / totals[0, pixel]


@kernel
def _middle_of(middle: Floats, ways: Floats) -> float:
    """Fill in the unit direction in the middle, and return how far the others are from it."""
    for axis in range(3):
        middle[axis] = ways[axis].sum()
    length = np.sqrt(middle[0] ** 2 + middle[1] ** 2 + middle[2] ** 2)
    if length < 1e-6:
        return 2.0
    middle /= length
    farthest = 0.0
    for pixel in range(_PIXELS):
        x, y, z = ways[0, pixel], ways[1, pixel], ways[2, pixel]
        chord = (x - middle[0]) ** 2 + (y - middle[1]) ** 2 + (z - middle[2]) ** 2
        farthest = max(farthest, chord)
    return float(np.sqrt(farthest))


@kernel
def _sum_square(
    totals: Floats,
    stack: NDArray[np.int64],
    light: Pieces,
    kind: int,
    sharpness: float,
    size: Floats,
    near: Floats,
    ways: Floats,
    middle: Floats,
    spread: float,
) -> None:
    """Add up, for each way, the lobe's weight, and the light times it in three channels."""
    texels = light.texels
    weights = np.empty(_PIXELS)
    for face in range(6):
        stack[0, 0], stack[0, 1], stack[0, 2] = len(light.sides) - 1, 0, 0
        held, at = next_piece(stack, 1, face, light, size, near, middle, spread)
        while at >= 0:
            _weigh(weights, kind, sharpness, ways, texels[at, 0], texels[at, 1], texels[at, 2])
            _add(totals[0], weights, texels[at, 3])
            _weigh(weights, kind, sharpness, ways, texels[at, 4], texels[at, 5], texels[at, 6])
            for channel in range(1, 4):
                _add(totals[channel], weights, texels[at, 6 + channel])
            held, at = next_piece(stack, held, face, light, size, near, middle, spread)


@kernel
def _weigh(
    weights: Floats, kind: int, sharpness: float, ways: Floats, x: float, y: float, z: float
) -> None:
    """Fill in the lobe's value towards a place for each way, 0 where that is behind."""
    # Loops of a length that is not known are vectorised; those of sixteen would be unrolled.
    for pixel in range(len(weights)):
        weights[pixel] = max(ways[0, pixel] * x + ways[1, pixel] * y + ways[2, pixel] * z, 0.0)
    if kind == PHONG:
        for pixel in range(len(weights)):
            if weights[pixel] > 0:
                weights[pixel] = value(kind, sharpness, weights[pixel])
        return
    for pixel in range(len(weights)):
        weights[pixel] = value(kind, sharpness, weights[pixel])


@kernel
def _add(total: Floats, weights: Floats, light: float) -> None:
    for pixel in range(len(weights)):
        total[pixel] += weights[pixel] * light
