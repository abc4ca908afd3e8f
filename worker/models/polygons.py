"""Faces of any number of corners as triangles."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from worker.errors import UnusableAssetError
from worker.numba_kernel import kernel

if TYPE_CHECKING:
    from numpy.typing import NDArray

CORNERS_MAX = 2**16
"""Corners of one face."""

_TESTS_MAX = 10**9
"""Corners looked at while ears are clipped, in one model: some seconds."""


def triangulate(
    positions: NDArray[np.float64], corners: NDArray[np.int32], starts: NDArray[np.int64]
) -> NDArray[np.int64]:
    """Split faces into triangles of the same winding: a face of n corners gives n - 2.

    Convex faces become fans round their first corner, others are split by clipping ears (Meisters,
    1975) in the plane of their largest projection. What crosses itself is split somehow.

    Args:
        positions: (n, 3).
        corners: (k,) indices of positions.
        starts: (f + 1,) where each face begins in `corners`, and the end; each has three or more.

    Returns:
        (m, 3) indices of corners, face by face.

    Raises:
        UnusableAssetError: `asset_too_large` for a face of too many corners, or too much to clip.
    """
    sizes = np.diff(starts)
    largest = int(sizes.max(initial=3))
    if largest > CORNERS_MAX:
        raise UnusableAssetError(
            f"a face has {largest} corners; the most is {CORNERS_MAX}", code="asset_too_large"
        )
    triangles = np.empty((int((sizes - 2).sum()), 3), np.int64)
    if not _split_all(positions, corners, starts, largest, triangles):
        raise UnusableAssetError(
            "its faces have too many hollows to be split into triangles", code="asset_too_large"
        )
    return triangles


@kernel
def _split_all(
    positions: NDArray[np.float64],
    corners: NDArray[np.int32],
    starts: NDArray[np.int64],
    largest: int,
    triangles: NDArray[np.int64],
) -> bool:
    flat = np.empty((largest, 2))
    following = np.empty(largest, np.int64)
    preceding = np.empty(largest, np.int64)
    reflex = np.empty(largest, np.bool_)
    filled, tests = 0, 0
    for face in range(len(starts) - 1):
        start, size = starts[face], starts[face + 1] - starts[face]
        hollow = False
        if size > 3:
            _flatten(positions, corners[start : start + size], flat)
            for i in range(size):
                after, before = (i + 1) % size, (i + size - 1) % size
                following[i], preceding[i] = after, before
                reflex[i] = _turn(flat, before, i, after) < 0
                hollow = hollow or reflex[i]
        if hollow:
            rows = triangles[filled : filled + size - 2]
            tests += _clip_ears(flat, following, preceding, reflex, size, rows)
            if tests > _TESTS_MAX:
                return False
            for row in range(size - 2):
                for k in range(3):
                    rows[row, k] += start
        else:
            for i in range(size - 2):
                triangles[filled + i, 0] = start
                triangles[filled + i, 1] = start + i + 1
                triangles[filled + i, 2] = start + i + 2
        filled += size - 2
    return True


@kernel
def _flatten(
    positions: NDArray[np.float64], face: NDArray[np.int32], flat: NDArray[np.float64]
) -> None:
    """Project a face along the largest part of its normal (Newell's), counter-clockwise."""
    nx, ny, nz = 0.0, 0.0, 0.0
    origin = positions[face[0]]
    for i in range(len(face)):
        a = positions[face[i]]
        b = positions[face[(i + 1) % len(face)]]
        nx += (a[1] - b[1]) * (a[2] + b[2] - 2 * origin[2])
        ny += (a[2] - b[2]) * (a[0] + b[0] - 2 * origin[0])
        nz += (a[0] - b[0]) * (a[1] + b[1] - 2 * origin[1])
    u, v, along = 0, 1, nz
    if abs(nx) > abs(nz) and abs(nx) >= abs(ny):
        u, v, along = 1, 2, nx
    elif abs(ny) > abs(nz):
        u, v, along = 2, 0, ny
    if along < 0:
        u, v = v, u
    for i in range(len(face)):
        flat[i, 0] = positions[face[i], u] - origin[u]
        flat[i, 1] = positions[face[i], v] - origin[v]


@kernel
def _turn(flat: NDArray[np.float64], a: int, b: int, c: int) -> float:
    """Twice the area of the triangle a, b, c; positive counter-clockwise."""
    bx, by = flat[b, 0] - flat[a, 0], flat[b, 1] - flat[a, 1]
    cx, cy = flat[c, 0] - flat[a, 0], flat[c, 1] - flat[a, 1]
    return float(bx * cy - by * cx)


@kernel
def _clip_ears(
    flat: NDArray[np.float64],
    following: NDArray[np.int64],
    preceding: NDArray[np.int64],
    reflex: NDArray[np.bool_],
    size: int,
    triangles: NDArray[np.int64],
) -> int:
    """Cut off ears until a triangle is left; return how many corners were looked at."""
    at, left, passed, tests = 0, size, 0, 0
    for row in range(size - 2):
        while True:
            before, after = preceding[at], following[at]
            if passed >= left:  # no ear anywhere: the face crosses itself, or has no area
                break
            passed += 1
            tests += 1
            if not reflex[at] and _turn(flat, before, at, after) > 0:
                tests += left
                if _is_ear(flat, following, reflex, before, at, after):
                    break
            at = after
        triangles[row, 0], triangles[row, 1], triangles[row, 2] = before, at, after
        following[before], preceding[after] = after, before
        reflex[before] = _turn(flat, preceding[before], before, after) < 0
        reflex[after] = _turn(flat, before, after, following[after]) < 0
        left -= 1
        passed = 0
        at = after
        if tests > _TESTS_MAX:
            break
    return tests


@kernel
def _is_ear(
    flat: NDArray[np.float64],
    following: NDArray[np.int64],
    reflex: NDArray[np.bool_],
    a: int,
    b: int,
    c: int,
) -> bool:
    """Whether no hollow corner lies in the triangle; one at the same place as its corners may."""
    at = following[c]
    while at != a:
        if (
            reflex[at]
            and _turn(flat, a, b, at) >= 0
            and _turn(flat, b, c, at) >= 0
            and _turn(flat, c, a, at) >= 0
            and not _same(flat, at, a)
            and not _same(flat, at, b)
            and not _same(flat, at, c)
        ):
            return False
        at = following[at]
    return True


@kernel
def _same(flat: NDArray[np.float64], a: int, b: int) -> bool:
    return bool(flat[a, 0] == flat[b, 0] and flat[a, 1] == flat[b, 1])
