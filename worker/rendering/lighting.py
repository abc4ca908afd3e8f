"""A request's lights as the uniforms that lib/lights.glsl reads."""

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from api_schemas.base import FLOAT32_MAX
from api_schemas.lights import AmbientLight, DirectionalLight, Light, PointLight, SpotLight
from worker.errors import RenderError
from worker.rendering.cookies import Cookies
from worker.rendering.light_views import Lamp, LightView, light_views
from worker.rendering.shading_layout import LightLayout

_SHARPEST_EDGE = 1e-6  # of a cone, in cosines; equal angles would divide by zero


@dataclass(frozen=True, slots=True)
class Lighting:
    """What shines on a scene.

    Attributes:
        uniforms: Of lit programs.
        views: The shadow maps that are drawn first.
        cookies: Pictures before lights.
        visibility: Whether a layer tells what comes through.
    """

    uniforms: Mapping[str, Any]
    views: tuple[LightView, ...]
    cookies: Cookies
    visibility: bool = False

    @property
    def layout(self) -> LightLayout:
        """What lit programs must know to be compiled."""
        return LightLayout(bool(self.views), self.cookies.layouts, self.visibility)


def lighting(
    lights: Sequence[Light],
    eye: NDArray[np.float64],
    cookies: Cookies,
    corners: Callable[[], NDArray[np.float64]],
    *,
    visibility: bool = False,
) -> Lighting:
    """Give the lights seen from the eye, in the request's order; ambient lights add up.

    Args:
        lights: The request's, or a model's, in the world.
        eye: Where it is in the world.
        cookies: The pictures before these lights.
        corners: Gives (n, 3), those of boxes that hold all that is drawn, in the world; asked for
            only where there are shadows.
        visibility: Whether a layer tells what comes through.

    Raises:
        RenderError: A light has no direction (`light_degenerate`).
    """
    ambient = np.zeros(3)
    rows = []
    lamps: list[Lamp] = []
    for index, light in enumerate(lights):
        if isinstance(light, AmbientLight):
            ambient += light.radiance
        else:
            rows.append(_row(light, index, eye))
            lamps.append(light)
    # A product may leave float32, and infinite light on a black surface is no number.
    ambient = np.minimum(ambient, FLOAT32_MAX)
    uniforms: dict[str, Any] = {"ambient_radiance": ambient, "light_count": len(rows)}
    if rows:
        table = np.clip(rows, -FLOAT32_MAX, FLOAT32_MAX).reshape(-1, 3, 4)
        names = ("light_position", "light_color", "light_axis")
        uniforms |= {name: table[:, column] for column, name in enumerate(names)}
    shaded = any(lamp.shadow is not None for lamp in lamps)
    views = light_views(lamps, corners()) if shaded else []
    if views:
        uniforms |= _shadow_uniforms(views, len(rows), eye)
    uniforms |= cookies.uniforms(eye)
    return Lighting(uniforms, tuple(views), cookies, visibility)


def _shadow_uniforms(
    views: Sequence[LightView], count: int, eye: NDArray[np.float64]
) -> dict[str, Any]:
    """Lay out the shadow maps as lib/shadows.glsl wants them; layer -1 is no map."""
    table = np.zeros((count, 5, 4))
    table[:, 4, 0] = -1
    layer = 0
    for view in views:
        row = table[view.light]
        row[:3, :3] = view.axes
        row[:3, 3] = view.axes @ (eye - view.origin)
        reach = view.reach if view.parallel else view.near
        row[3] = view.focal, reach, view.parallel, view.all_round
        row[4] = layer, view.resolution, view.radius, view.bias
        layer += view.faces
    names = ("shadow_across", "shadow_up", "shadow_along", "shadow_lens", "shadow_map")
    return {name: table[:, column] for column, name in enumerate(names)}


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
