"""From the seven ways in which glTF strings vertices together to triangles, lines and points."""

from typing import Final

import numpy as np
from numpy.typing import NDArray

from worker.geometry.mesh import MeshKind

POINTS, LINES, LINE_LOOP, LINE_STRIP, TRIANGLES, TRIANGLE_STRIP, TRIANGLE_FAN = range(7)
KINDS: Final[tuple[MeshKind, ...]] = (
    "points",
    "lines",
    "lines",
    "lines",
    "triangles",
    "triangles",
    "triangles",
)


def count_of(mode: int, length: int) -> int:
    """How many points, lines or triangles a number of indices gives at most."""
    match mode:
        case 0:
            return length
        case 1:
            return length // 2
        case 2:
            return length if length > 1 else 0
        case 3:
            return max(length - 1, 0)
        case 4:
            return length // 3
    return max(length - 2, 0)


def assemble(mode: int, indices: NDArray[np.int64]) -> NDArray[np.int64]:
    """String indices together as glTF 2.0, section 3.7.2.1, says.

    Every second triangle of a strip is turned round, so that all face the same way. Triangles of
    strips and fans with a vertex twice join their pieces and are left out.

    Args:
        mode: 0..6, as glTF numbers them.
        indices: (n,).

    Returns:
        (m, 1) points, (m, 2) lines or (m, 3) triangles; indices that are too few are left out.
    """
    count = count_of(mode, len(indices))
    match mode:
        case 0:
            return indices[:, None]
        case 1:
            return indices[: 2 * count].reshape(-1, 2)
        case 2:
            return np.stack([indices, np.roll(indices, -1)], axis=1)[:count]
        case 3:
            return np.stack([indices[:count], indices[1 : count + 1]], axis=1)
        case 4:
            return indices[: 3 * count].reshape(-1, 3)
    i = np.arange(count)
    if mode == TRIANGLE_STRIP:
        corners = np.stack([i, i + 1 + i % 2, i + 2 - i % 2], axis=1)
    else:
        corners = np.stack([i + 1, i + 2, np.zeros_like(i)], axis=1)
    return _whole(indices[corners] if count else np.zeros((0, 3), np.int64))


def _whole(triangles: NDArray[np.int64]) -> NDArray[np.int64]:
    a, b, c = triangles.T
    return np.asarray(triangles[(a != b) & (b != c) & (c != a)])
