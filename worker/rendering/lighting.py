"""A request's lights as the uniforms that lib/lights.glsl reads."""

import math
from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from api_schemas.base import FLOAT32_MAX
from api_schemas.lights import AmbientLight, DirectionalLight, Light, PointLight, SpotLight
from worker.errors import RenderError

_SHARPEST_EDGE = 1e-6  # of a cone, in cosines; equal angles would divide by zero


def light_uniforms(lights: Sequence[Light], eye: NDArray[np.float64]) -> dict[str, Any]:
    """Give the lights seen from the eye, in the request's order; ambient lights add up.

    Raises:
        RenderError: A light has no direction (`light_degenerate`).
    """
    ambient = np.zeros(3)
    rows = []
    for index, light in enumerate(lights):
        if isinstance(light, AmbientLight):
            ambient += light.radiance
        else:
            rows.append(_row(light, index, eye))
    # A product may leave float32, and infinite light on a black surface is no number.
    ambient = np.minimum(ambient, FLOAT32_MAX)
    uniforms: dict[str, Any] = {"ambient_radiance": ambient, "light_count": len(rows)}
    if rows:
        table = np.clip(rows, -FLOAT32_MAX, FLOAT32_MAX).reshape(-1, 3, 4)
        names = ("light_position", "light_color", "light_axis")
        uniforms |= {name: table[:, column] for column, name in enumerate(names)}
    return uniforms


def _row(
    light: DirectionalLight | PointLight | SpotLight, index: int, eye: NDArray[np.float64]
) -> list[float]:
    match light:
        case DirectionalLight():
            towards = -_direction(light.direction, index)
            strength = np.array(light.color) * light.irradiance
            return [*towards, 0.0, *strength, 1.0, 0.0, 0.0, 0.0, 0.0]
        case PointLight():
            strength = np.array(light.color) * light.intensity
            return [*(light.position - eye), 1.0, *strength, 1.0, 0.0, 0.0, 0.0, 0.0]
        case SpotLight():
            strength = np.array(light.color) * light.intensity
            edge = math.cos(light.outer_angle)
            slope = 1 / max(_SHARPEST_EDGE, math.cos(light.inner_angle) - edge)
            axis = _direction(light.direction, index)
            return [*(light.position - eye), 1.0, *strength, -edge * slope, *axis, slope]


def _direction(vector: Sequence[float], index: int) -> NDArray[np.float64]:
    length = math.hypot(*vector)
    if length == 0:
        raise RenderError(
            "a light's direction has no length",
            f"/scene/lights/{index}/direction",
            code="light_degenerate",
        )
    return np.array(vector) / length
