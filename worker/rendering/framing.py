"""Where a camera stands that shows everything, and what shines where nobody said."""

import math
from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from api_schemas.camera import FramedCamera, LookAt
from api_schemas.lights import AmbientLight, DirectionalLight, Light
from worker.geometry.transforms import Matrix, perspective, world_from_camera

_NEAREST = 1e-3
"""Least distance of the eye from things, of their size: what has no width is not stood in."""

_ROOM = 0.01
"""Share of the distance by which near and far planes keep off what is drawn."""


Placed = tuple[NDArray[np.floating], Matrix]
"""Vertices (n, 3) and the world_from_object matrix that places them."""


@dataclass(frozen=True, slots=True)
class Framing:
    """A perspective eye made for what it sees.

    Attributes:
        world_from_camera: Where it stands; a rigid motion.
        clip_from_camera: Its projection, with reversed depth.
    """

    world_from_camera: Matrix
    clip_from_camera: Matrix


def frame(
    camera: FramedCamera, placed: Iterable[Placed], aspect: float, *, endless: bool = False
) -> Framing:
    """Stand so that every vertex is in the picture, as near as that allows.

    Whether (x, y, z), in the camera's axes, is inside the left and right edges is linear in where
    the eye (a, b, c) is: |x - a| <= t (c - z), with t the edges' slope. So the vertices count only
    by the largest x + t z and -x + t z, and likewise in y: both ends of the tighter axis touch the
    margin, and the other axis is in the middle. Nothing at all is shown as if it were one point in
    the origin.

    Args:
        camera: From which side, and how much free space.
        placed: What is to be seen.
        aspect: Width over height of the picture.
        endless: Whether something else may come near the eye, which shall be seen too.

    Raises:
        RenderError: It has no direction, or up is along it (`camera_degenerate`).
    """
    axes = world_from_camera(LookAt(eye=camera.direction, target=[0.0] * 3, up=camera.up))[:3, :3]
    slope_y = math.tan(camera.fov_y / 2) / (1 + 2 * camera.margin)
    slope_x = slope_y * aspect
    edges = np.array([[1, 0, slope_x], [-1, 0, slope_x], [0, 1, slope_y], [0, -1, slope_y]])
    reaches = _reaches(placed, np.concatenate([edges, np.eye(3), -np.eye(3)]) @ axes.T)
    right, left, top, bottom = reaches[:4]
    front, back = reaches[6], reaches[9]
    size = (reaches[4:7] + reaches[7:]).max()
    nearest = _NEAREST * size if size > 0 else 1.0
    depth = max((right + left) / (2 * slope_x), (top + bottom) / (2 * slope_y), front + nearest)
    pose = np.eye(4)
    pose[:3, :3] = axes
    pose[:3, 3] = axes @ [(right - left) / 2, (top - bottom) / 2, depth]
    near, far = (depth - front) * (1 - _ROOM), (depth + back) * (1 + _ROOM)
    near = min(near, _NEAREST * far) if endless else near
    return Framing(pose, perspective(camera.fov_y, aspect, near, far))


def lamp(pose: Matrix) -> list[Light]:
    """Give the light of a studio: a lamp over the eye's right shoulder, and a bright room.

    White by Phong's formula is then just white in the picture, and white that divides by pi is
    seven tenths as bright to the eye.

    Args:
        pose: The eye's frame: world_from_camera.
    """
    right, up, back = pose[:3, :3].T
    travel = -(0.4 * right + 0.6 * up + back)
    return [
        AmbientLight(type="ambient", radiance=[0.2, 0.2, 0.2]),
        DirectionalLight(type="directional", direction=travel.tolist(), irradiance=0.8),
    ]


def _reaches(placed: Iterable[Placed], ways: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return how far everything reaches along each of the ways (k, 3) in the world."""
    reaches = [
        (vertices @ (ways @ matrix[:3, :3]).T).max(axis=0) + ways @ matrix[:3, 3]
        for vertices, matrix in placed
        if len(vertices)
    ]
    return np.max(reaches, axis=0) if reaches else np.zeros(len(ways))
