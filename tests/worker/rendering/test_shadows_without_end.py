"""Shadows on a plane without end (T38, T39): where the rays of the light say, and only there.

The square and the lights of test_shadows, over a plane instead of a floor.
"""

from typing import Any

import numpy as np
import pytest

from tests.worker.rendering.studio import Pixels, Studio
from tests.worker.rendering.test_shadows import (
    EXTENT,
    LIGHTS,
    MATT,
    SIZE,
    distance_to_edge,
    grid,
    scene,
)

pytestmark = pytest.mark.gl

SHADOW = {"bias": 0.1, "radius": 0}
GROUND = {"mesh": {"type": "infinite_plane"}, "surface": MATT}


def over_the_plane(light: dict[str, Any], **more: Any) -> dict[str, Any]:
    built = scene(light)
    built["nodes"][0] = GROUND
    return built | more


def share(studio: Studio, light: dict[str, Any], **more: Any) -> Pixels:
    """What of a light arrives: with its shadows over without; NaN where there is none at all."""
    plain = studio.draw(over_the_plane(light, **more), (SIZE, SIZE))[..., 0]
    shaded = studio.draw(over_the_plane(light | {"shadow": SHADOW}, **more), (SIZE, SIZE))[..., 0]
    return np.where(plain > 1e-6, shaded / np.maximum(plain, 1e-30), np.nan)


@pytest.mark.parametrize("name", LIGHTS)
def test_t38_a_shadow_lies_on_the_plane_where_the_rays_say(studio: Studio, name: str) -> None:
    # The map holds the square alone, 2 wide and 3.3 with the light's slant: texels of 0.0033
    # across the rays, three times that on the plane, so that two of them are 0.02. Of lights
    # nearby the whole cone is one map.
    light = dict(LIGHTS[name])
    seen = share(studio, light)
    inside = distance_to_edge(light)
    x, z = grid()
    ground = (np.maximum(abs(x), abs(z)) > 1) & ~np.isnan(seen)
    near = 0.06 if name == "sun" else 0.15

    assert (seen[ground & (inside > near)] == 0).all()
    assert (seen[ground & (inside < -near)] == 1).all()
    assert (ground & (inside > near)).sum() > 1000
    shadowed = np.nansum(np.where(ground, 1 - seen, 0)) * (EXTENT / SIZE) ** 2
    expected = (ground & (inside > 0)).sum() * (EXTENT / SIZE) ** 2
    assert shadowed == pytest.approx(expected, rel=0.02)


@pytest.mark.parametrize("name", LIGHTS)
def test_the_horizon_is_lit(studio: Studio, name: str) -> None:
    camera = {
        "type": "perspective",
        "fov_y": 1.0,
        "pose": {"eye": [0.0, 1.5, 8.0], "target": [0.0, 1.2, 0.0]},
    }

    seen = share(studio, dict(LIGHTS[name]), camera=camera)

    # The square and its shadow end 8 behind the origin: beyond 40 ahead nothing hides a light
    rows = np.arange(SIZE)
    slope = (1 - 2 * (rows + 0.5) / SIZE) * np.tan(0.5)
    down = 0.3 / 8 - slope  # about, of the ray, for one ahead
    far = seen[(down > 0) & (1.5 / np.maximum(down, 1e-9) > 48)]
    assert (~np.isnan(far)).sum() > (0 if "spot" in name else 500)
    assert (far[~np.isnan(far)] == 1).all()


@pytest.mark.parametrize("name", LIGHTS)
def test_a_plane_alone_has_no_shadows(studio: Studio, name: str) -> None:
    seen = share(studio, dict(LIGHTS[name]), nodes=[GROUND])

    assert (~np.isnan(seen)).sum() > 1000
    assert (seen[~np.isnan(seen)] == 1).all()


def test_a_plane_casts_none_on_what_is_behind_it(studio: Studio) -> None:
    # A wall without end between the sun and the square; it would be dark everywhere behind it
    wall = {
        "mesh": {"type": "infinite_plane", "facing": "+z"},
        "transform": {"translation": [0.0, 0.0, -30.0]},
        "surface": MATT,
    }
    sun = {"type": "directional", "direction": [0.0, -1.0, 1.0], "shadow": SHADOW}
    built = over_the_plane(sun)

    alone = studio.draw(built, (64, 64))
    behind = studio.draw(built | {"nodes": [*built["nodes"], wall]}, (64, 64))

    assert np.array_equal(alone, behind)
