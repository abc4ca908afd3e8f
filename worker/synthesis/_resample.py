"""Brings a tile to another size: area means where it shrinks, linear blends where it grows."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from worker.numba_kernel import kernel, parallel_kernel, prange

if TYPE_CHECKING:
    from numpy.typing import NDArray


class Taps(NamedTuple):
    """Which texels of an axis make each new one: texel firsts[i] + t, wrapped, by weights[i, t]."""

    firsts: NDArray[np.int64]
    weights: NDArray[np.float64]


def resample(pixels: NDArray[np.float32], size: tuple[int, int]) -> NDArray[np.float32]:
    """Return (height, width, channels) pixels at another (width, height), each axis on its own.

    An axis that keeps its length keeps its numbers bit for bit. Sums are in float64.
    """
    height, width, channels = pixels.shape
    new_width, new_height = size
    if (new_width, new_height) == (width, height):
        return pixels
    resampled = np.empty((new_height, new_width, channels), np.float32)
    _fill_resampled(
        resampled,
        np.array(pixels).reshape(height, width * channels),
        _taps(height, new_height),
        _taps(width, new_width),
    )
    return resampled


def _taps(old: int, new: int) -> Taps:
    index = np.arange(new)
    if new > old:
        # Twice the distance of the new centre from the centre of texel 0, in units of 1 / new
        distance = (2 * index + 1) * old - new
        firsts = distance // (2 * new)
        shares = distance % (2 * new) / (2 * new)
        return Taps(firsts, np.stack([1 - shares, shares], axis=1))
    # Edges of new and old texels in units of 1 / (old new): overlaps are exact integers
    firsts = index * old // new
    texels = firsts[:, np.newaxis] + np.arange((old + new - 1) // new + 1)
    starts = np.maximum(texels * new, (index * old)[:, np.newaxis])
    ends = np.minimum((texels + 1) * new, ((index + 1) * old)[:, np.newaxis])
    return Taps(firsts, np.maximum(ends - starts, 0) / old)


@parallel_kernel
def _fill_resampled(
    resampled: NDArray[np.float32], lines: NDArray[np.float32], rows: Taps, columns: Taps
) -> None:
    for row in prange(len(resampled)):
        _fill_row(resampled[row], lines, rows.firsts[row], rows.weights[row], columns)


@kernel
def _fill_row(
    texels: NDArray[np.float32],
    lines: NDArray[np.float32],
    first: int,
    weights: NDArray[np.float64],
    columns: Taps,
) -> None:
    width, channels = texels.shape
    height, length = lines.shape
    line = np.zeros(length, np.float64)
    # A weight of zero skips its texel, which may be infinite
    for tap in range(len(weights)):
        if weights[tap] > 0:
            _add_line(line, lines[(first + tap) % height], weights[tap])
    for column in range(width):
        for channel in range(channels):
            total = 0.0
            for tap in range(columns.weights.shape[1]):
                weight = columns.weights[column, tap]
                if weight > 0:
                    start = (columns.firsts[column] + tap) * channels
                    total += weight * line[(start + channel) % length]
            texels[column, channel] = total


@kernel
def _add_line(line: NDArray[np.float64], texels: NDArray[np.float32], weight: float) -> None:
    for i in range(len(line)):
        line[i] += weight * texels[i]
