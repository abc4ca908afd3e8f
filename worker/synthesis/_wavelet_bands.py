"""Coefficients of wavelet noise: white noise less what a grid half as fine can show of it.

Cook and DeRose, "Wavelet Noise", SIGGRAPH 2005. Grids join their opposite edges.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from worker.numba_kernel import parallel_kernel, prange
from worker.synthesis._counter_hash import hashes

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Rows = NDArray[np.float32]

# The published filters: the first at offsets -16..15, the second at -2..1
DOWN = np.array([
    0.000334, -0.001528, 0.000410, 0.003545, -0.000938, -0.008233, 0.002172, 0.019120,
    -0.005040, -0.044412, 0.011655, 0.103311, -0.025936, -0.243780, 0.033979, 0.655340,
    0.655340, 0.033979, -0.243780, -0.025936, 0.103311, 0.011655, -0.044412, -0.005040,
    0.019120, 0.002172, -0.008233, -0.000938, 0.003546, 0.000410, -0.001528, 0.000334,
], np.float32)  # fmt: skip
UP = np.array([0.25, 0.75, 0.75, 0.25], np.float32)
_RADIUS = len(DOWN) // 2


def band(seed: int, index: int, side: int, axes: int = 2) -> Rows:
    """Return the coefficients of a band, of an even side along each of two or three axes.

    The grid shifted by an odd number of half a side is added: the noise's variance at its grid
    points differs from that between them, and the sum evens that out.
    """
    fine = white_noise(seed, index, side, axes)
    coarse = fine
    for _ in range(axes):
        # Each time the last axis becomes the first, so in the end they are in order
        coarse = np.moveaxis(_coarse(coarse.reshape(-1, side)).reshape(fine.shape), -1, 0)
    detail = fine - coarse
    shift = side // 2 + (side // 2 + 1) % 2
    return np.ascontiguousarray(detail + np.roll(detail, (-shift,) * axes, tuple(range(axes))))


def white_noise(seed: int, use: int, side: int, axes: int = 2) -> Rows:
    """Return nearly Gaussian numbers of mean 0 and variance 1, side along each axis.

    Each is a sum of four.
    """
    quarters = hashes(seed, use, side**axes).view(np.uint16).reshape(*[side] * axes, 4)
    sums: NDArray[np.int32] = quarters.sum(axis=-1, dtype=np.int32) - 2 * 65535
    deviation = np.sqrt((65536.0**2 - 1) / 3)
    numbers: Rows = (sums / deviation).astype(np.float32)
    return numbers


def downsample(rows: Rows) -> Rows:
    """Halve the length of the last axis of (n, length) rows."""
    halves = np.empty((len(rows), rows.shape[1] // 2), np.float32)
    _fill_halves(halves, np.pad(rows, ((0, 0), (_RADIUS, _RADIUS)), "wrap"), DOWN)
    return halves


def upsample(halves: Rows) -> Rows:
    """Double the length of the last axis of (n, length) rows."""
    rows = np.empty((len(halves), 2 * halves.shape[1]), np.float32)
    following = np.roll(halves, -1, axis=1)
    rows[:, 0::2] = UP[2] * halves + UP[0] * following
    rows[:, 1::2] = UP[3] * halves + UP[1] * following
    return rows


def _coarse(rows: Rows) -> Rows:
    return upsample(downsample(np.ascontiguousarray(rows)))


@parallel_kernel
def _fill_halves(halves: Rows, padded: Rows, taps: Rows) -> None:
    for row in prange(len(halves)):
        for i in range(halves.shape[1]):
            total = np.float32(0)
            for tap in range(len(taps)):
                total += taps[tap] * padded[row, 2 * i + tap]
            halves[row, i] = total
