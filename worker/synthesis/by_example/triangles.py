"""A picture cut into triangles, whose corners are the middles of pieces that are blended."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Numbers = NDArray[np.float64]
    Indices = NDArray[np.int64]


class Corner(NamedTuple):
    """One of the three corners of the triangle that each pixel lies in, row by row.

    Attributes:
        number: Of the corner, (pixels,), below the number of all.
        away: How many rows and columns the pixel is away from it, (pixels, 2).
        weight: 1 at the corner, 0 on the other side of the triangle, (pixels,).
    """

    number: Indices
    away: Numbers
    weight: Numbers


def corners(size: tuple[int, int], step: int) -> tuple[list[Corner], int]:
    """Return the three corners of each pixel, and how many there are in all.

    The triangles go on around the edges of the picture.

    Args:
        size: Height and width.
        step: About how many pixels lie between corners.
    """
    height, width = size
    counts = np.array([max(1, round(length / step)) for length in size])
    rows, columns = (part.ravel() for part in np.indices(size))
    cells = np.stack([(rows + 0.5) * counts[0] / height, (columns + 0.5) * counts[1] / width], -1)
    corner = np.floor(cells).astype(np.int64)
    inner = cells - corner
    upper = inner.sum(axis=-1) < 1
    near = np.where(upper[:, np.newaxis], inner, 1 - inner)
    first = corner + ~upper[:, np.newaxis]
    turn = np.where(upper, 1, -1)
    found = []
    for axis in (None, 0, 1):
        vertex = first.copy()
        if axis is not None:
            vertex[:, axis] += turn
        number = (vertex[:, 0] % counts[0]) * counts[1] + vertex[:, 1] % counts[1]
        away = (cells - vertex) * np.array(size) / counts
        weight = 1 - near.sum(axis=-1) if axis is None else near[:, axis]
        found.append(Corner(number, away, weight))
    return found, int(counts.prod())
