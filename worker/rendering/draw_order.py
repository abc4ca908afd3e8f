"""What is drawn before what: pure arrays, so that it can be told without OpenGL."""

import numpy as np
from numpy.typing import NDArray

_PAIRS_MAX = 1 << 21
"""Triangles times vertices up to which a shape is asked whether it is convex: some 20 ms."""

_FLATNESS = 1e-5
"""How far beyond a face a vertex may lie, of the shape's size: float32 rounds positions."""


def nearness(
    centres: NDArray[np.float64], world_from_camera: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Return how far points lie towards the eye along the view: more is nearer.

    Args:
        centres: (n, 3) in the world.
        world_from_camera: The eye's frame, 4 x 4; it looks along its own -z.
    """
    offsets = centres - world_from_camera[:3, 3]
    nearer: NDArray[np.float64] = offsets @ world_from_camera[:3, 2]
    return nearer


def back_to_front(
    positions: NDArray[np.floating], elements: NDArray[np.uint32], towards_eye: NDArray[np.float64]
) -> NDArray[np.uint32]:
    """Sort triangles, lines or points by the nearness of their middles, the farthest first.

    That is right wherever what overlaps is small against its distance from each other; large
    triangles that reach past each other need more than an order. Equally near ones keep theirs.

    Args:
        positions: (n, 3) in the object's frame.
        elements: (m, k) vertex numbers of each.
        towards_eye: The direction in the object's frame along which things are nearer: the third
            row of camera_from_object.
    """
    nearer = positions @ towards_eye
    order = np.argsort(nearer[elements].sum(axis=1), kind="stable")
    return elements[order]


def is_convex(positions: NDArray[np.floating], triangles: NDArray[np.uint32]) -> bool:
    """Tell whether triangles are a convex shape or a part of one, seen from outside.

    Then each ray meets it twice at most, first an outer and then an inner side: drawing all inner
    sides before all outer ones is exact from any place. Shapes too large to ask are not.

    Args:
        positions: (n, 3).
        triangles: (m, 3), counter-clockwise seen from outside.
    """
    if len(triangles) * len(positions) > _PAIRS_MAX:
        return False
    corners = positions[triangles].astype(np.float64)
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    lengths = np.linalg.norm(normals, axis=1, keepdims=True)
    normals = np.divide(normals, lengths, out=np.zeros_like(normals), where=lengths > 0)
    heights = normals @ positions.astype(np.float64).T
    beyond = heights.max(axis=1) - np.einsum("ij,ij->i", normals, corners[:, 0])
    return bool(beyond.max(initial=0.0) <= _FLATNESS * np.ptp(positions, axis=0).max(initial=0.0))
