"""From corners of triangles to vertices that triangles share, and to smooth normals."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np

from worker.numba_kernel import kernel

if TYPE_CHECKING:
    from numpy.typing import NDArray


def number_rows(keys: NDArray[np.int64]) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """Number rows in the order in which different ones first appear.

    Args:
        keys: (k, c).

    Returns:
        The number of each row (k,), and for each number the row where it first appears.
    """
    numbers = np.empty(len(keys), np.int64)
    firsts = np.empty(len(keys), np.int64)
    slots = np.full(1 << (2 * len(keys)).bit_length(), -1, np.int32)
    count = _number_rows(np.ascontiguousarray(keys).view(np.uint64), slots, numbers, firsts)
    return numbers, firsts[:count].copy()


@kernel
def _number_rows(
    keys: NDArray[np.uint64],
    slots: NDArray[np.int32],
    numbers: NDArray[np.int64],
    firsts: NDArray[np.int64],
) -> int:
    mask = np.uint64(len(slots) - 1)
    count = 0
    for row in range(len(keys)):
        mixed = np.uint64(0)
        for column in range(keys.shape[1]):  # splitmix64's finisher (Steele et al., 2014)
            mixed = (mixed ^ keys[row, column]) + np.uint64(0x9E3779B97F4A7C15)
            mixed = (mixed ^ (mixed >> np.uint64(30))) * np.uint64(0xBF58476D1CE4E5B9)
            mixed = (mixed ^ (mixed >> np.uint64(27))) * np.uint64(0x94D049BB133111EB)
            mixed ^= mixed >> np.uint64(31)
        slot = mixed & mask
        while slots[slot] >= 0 and not _equal(keys, firsts[slots[slot]], row):
            slot = (slot + np.uint64(1)) & mask
        if slots[slot] < 0:
            slots[slot] = count
            firsts[count] = row
            count += 1
        numbers[row] = slots[slot]
    return count


@kernel
def _equal(keys: NDArray[np.uint64], a: int, b: int) -> bool:
    column = 0
    while column < keys.shape[1] and keys[a, column] == keys[b, column]:
        column += 1
    return bool(column == keys.shape[1])


def used(indices: NDArray[np.integer[Any]], count: int) -> NDArray[np.bool_]:
    """Say of each of `count` things whether any index names it; -1 names none."""
    named = np.zeros(count + 1, np.bool_)
    named[indices] = True
    return named[:count]


def smooth_normals(
    positions: NDArray[np.float64],
    triangles: NDArray[np.int64],
    joints: NDArray[np.int64],
    count: int,
) -> NDArray[np.float64]:
    """Average the normals of the triangles that meet, each weighted with its angle there.

    The angle makes the mean independent of how a flat face was split (Thürmer and Wüthrich, 1998).

    Args:
        positions: (n, 3), finite.
        triangles: (m, 3) indices of positions.
        joints: (m, 3), which normal each corner has a share in.
        count: How many normals there are.

    Returns:
        (count, 3) of unit length; +z where there are only triangles without area.
    """
    normals = np.zeros((count, 3))
    _add_shares(positions, triangles, joints, normals)
    return normalised(normals)


def flat_normals(corners: NDArray[np.float64]) -> NDArray[np.float64]:
    """Give the normals (m, 3) of triangles (m, 3, 3), counter-clockwise seen from outside."""
    sides = corners[:, 1:] - corners[:, :1]
    return normalised(np.cross(sides[:, 0], sides[:, 1]))


def normalised(vectors: NDArray[np.float64]) -> NDArray[np.float64]:
    """Scale rows to length 1; those without a direction become +z."""
    largest = np.abs(vectors).max(axis=1, keepdims=True, initial=0.0)
    has_none = ~(np.isfinite(largest) & (largest > 0))[:, 0]
    with np.errstate(invalid="ignore", divide="ignore"):
        scaled = vectors / largest
        unit = scaled / np.linalg.norm(scaled, axis=1, keepdims=True)
    unit[has_none] = (0.0, 0.0, 1.0)
    return np.asarray(unit, np.float64)


@kernel
def _add_shares(
    positions: NDArray[np.float64],
    triangles: NDArray[np.int64],
    joints: NDArray[np.int64],
    normals: NDArray[np.float64],
) -> None:
    for row in range(len(triangles)):
        a, b, c = triangles[row, 0], triangles[row, 1], triangles[row, 2]
        ab = _direction(positions[a], positions[b])
        bc = _direction(positions[b], positions[c])
        ca = _direction(positions[c], positions[a])
        _add_share(normals[joints[row, 0]], ca, ab)
        _add_share(normals[joints[row, 1]], ab, bc)
        _add_share(normals[joints[row, 2]], bc, ca)


@kernel
def _direction(start: NDArray[np.float64], end: NDArray[np.float64]) -> tuple[float, float, float]:
    """Give the unit vector from one point to another, or zeros."""
    x, y, z = end[0] - start[0], end[1] - start[1], end[2] - start[2]
    largest = max(abs(x), abs(y), abs(z))
    if largest == 0:
        return 0.0, 0.0, 0.0
    x, y, z = x / largest, y / largest, z / largest
    length = math.sqrt(x * x + y * y + z * z)
    return x / length, y / length, z / length


@kernel
def _add_share(
    normal: NDArray[np.float64],
    coming: tuple[float, float, float],
    going: tuple[float, float, float],
) -> None:
    """Add the normal of a corner between two sides, as long as the angle there."""
    x = coming[1] * going[2] - coming[2] * going[1]
    y = coming[2] * going[0] - coming[0] * going[2]
    z = coming[0] * going[1] - coming[1] * going[0]
    sine = math.sqrt(x * x + y * y + z * z)
    if sine > 0:
        cosine = -(coming[0] * going[0] + coming[1] * going[1] + coming[2] * going[2])
        weight = math.atan2(sine, cosine) / sine
        normal[0] += x * weight
        normal[1] += y * weight
        normal[2] += z * weight
