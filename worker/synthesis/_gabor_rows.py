"""A Gabor kernel along one row of pixels or voxels, and where it is cut."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from worker.numba_kernel import kernel

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Numbers = NDArray[np.float64]

CUT = float(np.sqrt(np.log(1000) / np.pi))
"""Radius of a kernel times its bandwidth: there the Gaussian is 1/1000."""


@kernel
def tabulate(
    cosines: Numbers,
    sines: Numbers,
    first: int,
    last: int,
    middle: float,
    width: int,
    along: float,
    bandwidth: float,
) -> None:
    """Fill wave times Gaussian, and the wave a quarter on, from a column to another."""
    for column in range(first, last + 1):
        x = (column + 0.5) / width - middle
        under = np.exp(-np.pi * (bandwidth * x) ** 2)
        cosines[column - first] = under * np.cos(2 * np.pi * along * x)
        sines[column - first] = under * np.sin(2 * np.pi * along * x)


@kernel
def add(
    row: Numbers, first: int, count: int, a: float, b: float, cosines: Numbers, sines: Numbers
) -> None:
    """Add a cos - b sin to a row from a column on, and again from its start beyond its end."""
    width = len(row)
    done = 0
    while done < count:
        start = (first + done) % width
        length = min(count - done, width - start)
        piece = row[start : start + length]
        cosine, sine = cosines[done : done + length], sines[done : done + length]
        for i in range(length):
            piece[i] += a * cosine[i] - b * sine[i]
        done += length
