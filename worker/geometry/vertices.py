"""From corners of triangles to vertices that triangles share, and to smooth normals."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

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
    slots = np.full(1 << max(2 * len(keys), 2).bit_length(), -1, np.int64)
    count = _number_rows(np.ascontiguousarray(keys).view(np.uint64), slots, numbers, firsts)
    return numbers, firsts[:count].copy()


@kernel
def _number_rows(
    keys: NDArray[np.uint64],
    slots: NDArray[np.int64],
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
    sides = np.empty((3, 3))
    for row in range(len(triangles)):
        for k in range(3):
            a, b = triangles[row, k], triangles[row, (k + 1) % 3]
            length = 0.0
            for axis in range(3):
                sides[k, axis] = positions[b, axis] - positions[a, axis]
                length = max(length, abs(sides[k, axis]))
            if length > 0:
                sides[k] /= length
                sides[k] /= math.sqrt((sides[k] ** 2).sum())
        for k in range(3):
            to, back = sides[k], sides[(k + 2) % 3]
            x = back[1] * to[2] - back[2] * to[1]
            y = back[2] * to[0] - back[0] * to[2]
            z = back[0] * to[1] - back[1] * to[0]
            sine = math.sqrt(x * x + y * y + z * z)
            if sine > 0:
                angle = math.atan2(sine, -(to * back).sum())
                joint = joints[row, k]
                normals[joint, 0] += x / sine * angle
                normals[joint, 1] += y / sine * angle
                normals[joint, 2] += z / sine * angle
