"""An eye and a lamp for scenes that bring none."""

import math
from collections.abc import Iterable

import numpy as np
from numpy.typing import NDArray

from api_schemas.camera import FramedCamera, LookAt, PerspectiveCamera
from api_schemas.lights import AmbientLight, DirectionalLight, Light

Box = tuple[NDArray[np.float64], NDArray[np.float64]]
"""Lowest and highest x, y, z."""


def frame(camera: FramedCamera, boxes: Iterable[Box], aspect: float) -> PerspectiveCamera:
    """Place a camera so that all boxes are seen.

    Args:
        camera: From which side, and how much free space.
        boxes: What is to be seen, in world axes; nothing is a cube of side 2 round the origin.
        aspect: Width over height of the picture.
    """
    found = list(boxes)
    lowest = np.min([low for low, _ in found], axis=0) if found else -np.ones(3)
    highest = np.max([high for _, high in found], axis=0) if found else np.ones(3)
    middle = (lowest + highest) / 2
    radius = max(float(np.linalg.norm(highest - lowest)) / 2, 1e-5)
    narrow = math.atan(math.tan(camera.fov_y / 2) * min(1.0, aspect))
    distance = radius * (1 + 2 * camera.margin) / math.sin(narrow)
    direction = np.array(camera.direction) / np.linalg.norm(camera.direction)
    return PerspectiveCamera(
        type="perspective",
        pose=LookAt(eye=list(middle + distance * direction), target=list(middle), up=camera.up),
        fov_y=camera.fov_y,
        near=max(distance - 1.01 * radius, 1e-3 * distance),
        far=distance + 1.01 * radius,
    )


def lamp(
    right: NDArray[np.float64], up: NDArray[np.float64], back: NDArray[np.float64]
) -> list[Light]:
    """Give the light of a studio: a lamp over the eye's right shoulder, and a brighter room.

    Args:
        right: Of the picture, a unit vector in world axes.
        up: The same, upwards.
        back: The same, towards the eye.
    """
    travel = -(0.4 * right + 0.6 * up + back)
    return [
        AmbientLight(type="ambient", radiance=[0.35, 0.35, 0.35]),
        DirectionalLight(type="directional", direction=list(travel), irradiance=2.0),
    ]
