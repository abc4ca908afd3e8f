"""Where a camera stands that shows everything, and what shines where nobody said."""

import math
from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from api_schemas.lights import AmbientLight, DirectionalLight, Light
from worker.geometry.transforms import Matrix, perspective

_NEAREST = 1e-3
"""Least distance of the eye from things, of their size: what has no width is not stood in."""

_ROOM = 0.01
"""Share of the distance by which near and far planes keep off what is drawn."""


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
    placed: Iterable[tuple[NDArray[np.floating], Matrix]],
    direction: NDArray[np.float64],
    fov_y: float,
    margin: float,
    aspect: float,
) -> Framing:
    """Stand so that every vertex is in the picture, as near as that allows.

    Whether (x, y, z), in the camera's axes, is inside the left and right edges is linear in where
    the eye (a, b, c) is: |x - a| <= t (c - z), with t the edges' slope. So the vertices count only
    by the largest x + t z and -x + t z, and likewise in y: both ends of the tighter axis touch the
    margin, and the other axis is in the middle.

    Args:
        placed: Vertices (n, 3) with the world_from_object matrices that place them. Nothing at all
            is shown as if it were a point in the origin.
        direction: From where one looks, of any length but zero.
        fov_y: Angle in radians from the lower to the upper edge.
        margin: Share of the picture that stays free along each edge, below 1/2.
        aspect: Width over height of the picture.
    """
    axes = _axes(direction)
    slope_y = math.tan(fov_y / 2) * (1 - 2 * margin)
    slope_x = slope_y * aspect
    ways = np.array(
        [
            [1, 0, slope_x],
            [-1, 0, slope_x],
            [0, 1, slope_y],
            [0, -1, slope_y],
            [0, 0, 1],
            [0, 0, -1],
        ]
    )
    reaches = _farthest(placed, np.concatenate([ways, np.eye(3), -np.eye(3)]) @ axes.T)
    right, left, top, bottom, front, back = reaches[:6]
    size = (reaches[6:9] + reaches[9:]).max()
    nearest = _NEAREST * size if size > 0 else 1.0
    depth = max((right + left) / (2 * slope_x), (top + bottom) / (2 * slope_y), front + nearest)
    world_from_camera = np.eye(4)
    world_from_camera[:3, :3] = axes
    world_from_camera[:3, 3] = axes @ [(right - left) / 2, (top - bottom) / 2, depth]
    near, far = (depth - front) * (1 - _ROOM), (depth + back) * (1 + _ROOM)
    return Framing(world_from_camera, perspective(fov_y, aspect, near, far))


def studio_lights(world_from_camera: Matrix) -> list[Light]:
    """Shine over the eye's right shoulder, and a little from everywhere."""
    axes = world_from_camera[:3, :3]
    towards = axes @ [0.5, 0.7, 1.0]
    return [
        AmbientLight(type="ambient", radiance=[0.2, 0.2, 0.2]),
        DirectionalLight(type="directional", direction=(-towards).tolist(), irradiance=1.0),
    ]


def _axes(direction: NDArray[np.float64]) -> NDArray[np.float64]:
    """Give the columns right, up and backward: y is up, but -z where one looks along y."""
    backward = direction / np.linalg.norm(direction)
    upright = abs(backward[1]) < 1 - 1e-9
    up = np.array([0.0, 1.0, 0.0] if upright else [0.0, 0.0, -math.copysign(1.0, backward[1])])
    right = np.cross(up, backward)
    right /= np.linalg.norm(right)
    return np.stack([right, np.cross(backward, right), backward], axis=1)


def _farthest(
    placed: Iterable[tuple[NDArray[np.floating], Matrix]], ways: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Return how far everything reaches along each of the ways (k, 3) in the world."""
    reaches = [
        (vertices @ (ways @ matrix[:3, :3]).T).max(axis=0) + ways @ matrix[:3, 3]
        for vertices, matrix in placed
        if len(vertices)
    ]
    return np.max(reaches, axis=0) if reaches else np.zeros(len(ways))
