"""Scenes in an environment: directions as colours, a ball, and what it should show."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from tests.worker.rendering.studio import Studio

MIRROR = {"technique": "metallic_roughness", "metallic": 1.0, "roughness": 0.0}
CHALK = {"technique": "metallic_roughness", "metallic": 0.0, "specular": 0.0}
BALL_CAMERA = {"type": "orthographic", "height": 2.0, "pose": {"eye": [0.0, 0.0, 4.0]}}


def latlong(width: int) -> NDArray[np.float64]:
    """Directions (width / 2, width, 3) of a picture in OpenEXR's convention, +z in the middle."""
    u = (np.arange(width) + 0.5) / width
    latitude = np.pi * (0.5 - (np.arange(width // 2) + 0.5) / (width // 2))
    longitude, latitude = np.meshgrid(2 * np.pi * (0.5 - u), latitude)
    across = np.cos(latitude)
    return np.stack(
        [np.sin(longitude) * across, np.sin(latitude), np.cos(longitude) * across], axis=-1
    )


def coded(directions: NDArray[np.float64]) -> NDArray[np.float64]:
    """Colours 0..1 of directions."""
    return 0.5 + 0.5 * directions


def ball(
    studio: Studio, environment: dict[str, Any], surface: dict[str, Any], side: int, **more: Any
) -> NDArray[np.float32]:
    """Draw a unit sphere, seen from +z by parallel rays, that fills a square."""
    mesh = {"type": "sphere", "segments": 512, "rings": 256}
    scene = {
        "camera": BALL_CAMERA,
        "environment": environment,
        "nodes": [{"mesh": mesh, "surface": surface}],
    }
    return studio.draw(scene, (side, side), more.get("supersampling", 1))


def ball_normals(side: int) -> tuple[NDArray[np.float64], NDArray[np.bool_]]:
    """Normals (side, side, 3) of that sphere, and which pixels are on it."""
    place = (2 * np.arange(side) + 1) / side - 1
    x, y = np.meshgrid(place, -place)
    squared = x * x + y * y
    z = np.sqrt(np.maximum(1 - squared, 0))
    return np.stack([x, y, z], axis=-1), squared < 1


def mirrored(normals: NDArray[np.float64]) -> NDArray[np.float64]:
    """Directions in which the eye at +z looks in a mirror."""
    reflected = 2 * normals[..., 2:] * normals
    reflected[..., 2] -= 1
    return reflected
