"""Planes without end: each pixel's ray is met with the plane, instead of rasterising triangles.

Where (x, y) on the screen meets the plane is a projective map: with C taking (u, v, 1) to the x, y
and w of clip space, its inverse takes (x, y, 1) to (u, v, 1) / w. So u / w, v / w and 1 / w are
linear on the screen, for perspective and parallel views alike, up to the horizon, where 1 / w is 0.
"""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from worker.geometry.transforms import Matrix

_HORIZON_PIXELS = 1e5
"""From the middle of what is drawn; a horizon that is farther away plays no part."""
_EDGE_ON = 1e-12
"""Sine of the angle of view below which a plane is a line."""


def plane_uniforms(
    tile: NDArray[np.float64],
    clip_from_object: Matrix,
    eye_from_object: Matrix,
    size: NDArray[np.int64],
) -> dict[str, Any]:
    """Give what lib/infinite_plane.glsl wants.

    Args:
        tile: (2, 3), the extent of one texture along u and v in the object's frame.
        clip_from_object: For the part of the picture that is drawn.
        eye_from_object: Axes of the world, origin at the eye.
        size: Width and height of that part in samples.
    """
    object_from_plane = _object_from_plane(tile)
    clip_from_plane = clip_from_object @ object_from_plane
    screen_from_pixel = np.array([[2 / size[0], 0, -1], [0, 2 / size[1], -1], [0, 0, 1]])
    plane_from_pixel = np.linalg.inv(clip_from_plane[[0, 1, 3]]) @ screen_from_pixel
    origin = _near_horizon(plane_from_pixel[2], size)
    plane_from_pixel[:, 2] = plane_from_pixel @ np.append(origin, 1.0)
    return {
        "pixel_origin": origin,
        "plane_from_pixel": plane_from_pixel,
        "position_from_pixel": (eye_from_object @ object_from_plane)[:3] @ plane_from_pixel,
        "object_from_pixel": object_from_plane[:3] @ plane_from_pixel,
        "depth_from_pixel": clip_from_plane[2] @ plane_from_pixel,
    }


def whole_target(tile: NDArray[np.float64]) -> Matrix:
    """Give the matrix that lets the plane's triangle cover all of clip space."""
    matrix = np.zeros((4, 4))
    matrix[:2, :3] = tile / (tile**2).sum(axis=1, keepdims=True)
    matrix[3, 3] = 1.0
    return matrix


def eye_side(
    tile: NDArray[np.float64],
    world_from_object: Matrix,
    world_from_camera: Matrix,
    *,
    orthographic: bool,
) -> int:
    """Tell from where a plane is seen: 1 from outside, -1 from inside, 0 edge-on."""
    u, v = tile @ world_from_object[:3, :3].T
    normal = np.cross(u, v) * np.sign(np.linalg.det(world_from_object[:3, :3]))
    towards_eye = (
        world_from_camera[:3, 2]
        if orthographic
        else world_from_camera[:3, 3] - world_from_object[:3, 3]
    )
    height = normal @ towards_eye
    bound = _EDGE_ON * np.linalg.norm(normal) * np.linalg.norm(towards_eye)
    return int(np.sign(height)) if abs(height) > bound else 0


def _near_horizon(inverse_w: NDArray[np.float64], size: NDArray[np.int64]) -> NDArray[np.float64]:
    """Choose where pixels are counted from, so that the small 1 / w far away keep their digits.

    Args:
        inverse_w: (3,), 1 / w is its product with (x, y, 1).
        size: Width and height of the part that is drawn.
    """
    middle = size / 2
    slope = inverse_w[:2]
    steepness = slope @ slope
    height = float(slope @ middle + inverse_w[2])
    if height**2 > steepness * _HORIZON_PIXELS**2:
        return np.rint(middle)
    foot: NDArray[np.float64] = np.rint(middle - slope * (height / steepness))
    return foot


def _object_from_plane(tile: NDArray[np.float64]) -> Matrix:
    matrix = np.zeros((4, 3))
    matrix[:3, :2] = tile.T
    matrix[3, 2] = 1.0
    return matrix
