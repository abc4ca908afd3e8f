"""Where on a picture coordinates look: planes, normals, mirrors and glass."""

import math
from typing import Any

import numpy as np
import pytest

from api_schemas.layouts.latlong import LatlongSpec
from tests.worker.rendering.coded import (
    MIDDLES,
    ORTHOGRAPHIC,
    angles,
    directions,
    pixel_middles,
    places,
    shown,
)
from tests.worker.rendering.studio import Studio

pytestmark = pytest.mark.gl

LATLONG = LatlongSpec(technique="latlong")
PLANE = {"type": "plane", "width": 2.0, "height": 2.0}
TURNED = [0.0, math.sin(0.3), 0.0, math.cos(0.3)]  # by 0.6 round y
WORLD_FROM_TURNED = np.array(
    [[math.cos(0.6), 0, math.sin(0.6)], [0, 1, 0], [-math.sin(0.6), 0, math.cos(0.6)]]
)


def mapped(texture: Any, technique: str, layout: Any = None, **more: Any) -> dict[str, Any]:
    parameters = more.pop("parameters", {})
    return {
        "texture": texture,
        "coordinates": {"technique": technique, **parameters},
        "layout": layout and layout.model_dump(),
        "filter": "bilinear",
        **more,
    }


@pytest.mark.parametrize("frame", ["object", "world", "view"])
def test_t25_a_place_is_moved_by_a_matrix(studio: Studio, frame: str) -> None:
    # A x + b with the object twice as large, turned round y, and shifted
    matrix = [[0.1, 0.02, 0.03], [-0.02, 0.05, 0.01], [9.0, 9.0, 9.0]]
    offset = [0.5, 0.4, 7.0]
    eye = np.array([0.3, 0.0, 4.0])

    drawn = shown(
        studio,
        PLANE,
        mapped(
            places(studio),
            "position",
            parameters={"frame": frame, "matrix": matrix, "offset": offset},
        ),
        camera={**ORTHOGRAPHIC, "pose": {"eye": list(eye), "target": [0.3, 0.0, 0.0]}},
        transform={"translation": [0.3, 0.0, -1.0], "rotation": TURNED, "scale": [2.0, 2.0, 2.0]},
    )

    x, y = pixel_middles(64)
    across = x / math.cos(0.6)  # along the turned plane
    world = np.stack([x + 0.3, y, -1 - across * math.sin(0.6)], axis=-1)
    place = {
        "object": np.stack([across / 2, y / 2, 0 * y], axis=-1),
        "world": world,
        "view": world - eye,
    }[frame]
    wanted = place @ np.array(matrix)[:2].T + np.array(offset)[:2]
    np.testing.assert_allclose(drawn[..., :2], wanted, atol=2e-6)


def test_t25_a_picture_is_drawn_out_along_what_the_matrix_leaves_out(studio: Studio) -> None:
    # The wooden ball: (y, z) of every point, whatever its x
    color = mapped(
        places(studio),
        "position",
        parameters={"matrix": [[0, 0.5, 0], [0, 0, 0.5], [0, 0, 0]], "offset": [0.5, 0.5, 0]},
    )
    camera = {**ORTHOGRAPHIC, "pose": {"eye": [4.0, 0.0, 0.0]}}

    drawn = shown(studio, {"type": "sphere", "segments": 256, "rings": 128}, color, camera=camera)

    right, up = pixel_middles(64)
    inside = np.hypot(right, up) < 0.9
    wanted = np.stack([0.5 + 0.5 * up, 0.5 - 0.5 * right], axis=-1)
    np.testing.assert_allclose(drawn[inside][:, :2], wanted[inside], atol=2e-6)


@pytest.mark.parametrize("frame", ["object", "world", "view"])
def test_t33_a_normal_is_a_direction_of_its_frame(studio: Studio, frame: str) -> None:
    color = mapped(places(studio), "normal", parameters={"frame": frame}, transform=MIDDLES)
    camera = {**ORTHOGRAPHIC, "pose": {"eye": [4.0, 0.0, 0.0]}}

    drawn = shown(
        studio,
        {"type": "sphere", "segments": 256, "rings": 128},
        color,
        camera=camera,
        transform={"rotation": TURNED},
    )

    right, up = pixel_middles(64)
    out = np.sqrt(np.maximum(0, 1 - right**2 - up**2))
    world = np.stack([out, up, -right], axis=-1)
    seen = np.stack([right, up, out], axis=-1)
    wanted = {"object": world @ WORLD_FROM_TURNED, "world": world, "view": seen}[frame]
    inside = np.hypot(right, up) < 0.9
    # Facets hide 1 - cos(pi / 256) of the radius, 2.4 times that at the rim, and half is coded
    np.testing.assert_allclose(drawn[inside][:, :2], 0.5 + 0.4 * wanted[inside][:, :2], atol=3e-4)


def test_t33_a_normal_of_a_stretched_mesh_is_told_in_its_own_frame(studio: Studio) -> None:
    color = mapped(places(studio), "normal", parameters={"frame": "object"}, transform=MIDDLES)

    drawn = shown(
        studio,
        {"type": "sphere", "segments": 256, "rings": 128},
        color,
        transform={"scale": [1.0, 0.5, 1.0]},
    )

    x, y = pixel_middles(64)
    inside = np.hypot(x, 2 * y) < 0.9
    wanted = 0.5 + 0.4 * np.stack([x, 2 * y], axis=-1)
    np.testing.assert_allclose(drawn[inside][:, :2], wanted[inside], atol=3e-4)


def test_t34_a_mirror_ball_shows_the_environment(studio: Studio) -> None:
    # Show 3: a ball of 512 x 256 facets in a 2048 x 1024 environment of directions. Left out are
    # pixels whose middle is less than an eighth of a pixel from the rim: there n.v < .04, and
    # facets, which hide up to 3.8e-5 of the radius, turn reflections by twice that over n.v.
    size, distance = 512, 3.0
    camera = {"type": "perspective", "fov_y": math.pi / 3, "pose": {"eye": [0.0, 0.0, distance]}}
    color = mapped(directions(studio, LATLONG, 2048, 1024), "reflection", LATLONG)
    del color["filter"]

    drawn = shown(
        studio, {"type": "sphere", "segments": 512, "rings": 256}, color, size, camera=camera
    )

    x, y = pixel_middles(size)
    rays = np.stack([x * math.tan(math.pi / 6), y * math.tan(math.pi / 6), -1 + 0 * x], axis=-1)
    rays /= np.linalg.norm(rays, axis=-1, keepdims=True)
    middle = rays @ np.array([0.0, 0.0, distance])
    squared = middle**2 - (distance**2 - 1)  # (n.v)^2 where the ray meets the ball
    hit = squared > 0.04**2
    normals = [0, 0, distance] - (middle + np.sqrt(np.maximum(squared, 0)))[..., None] * rays
    wanted = rays - 2 * (rays * normals).sum(axis=-1, keepdims=True) * normals
    error = angles(drawn[..., :3], wanted)
    assert error[hit].max() <= 0.12
    assert error[squared > 0.15**2].max() <= 0.03


def test_t34_an_object_s_reflections_may_turn_with_it(studio: Studio) -> None:
    picture = directions(studio, LATLONG, 256, 128)
    color = mapped(picture, "reflection", LATLONG, parameters={"frame": "object"})

    drawn = shown(studio, PLANE, color, transform={"rotation": TURNED})

    # A mirror turned by 0.6 shows what is 1.2 aside in the world, 0.6 in its own frame
    wanted = np.array([math.sin(0.6), 0.0, math.cos(0.6)])
    assert angles(drawn[32, 32, :3], wanted) < 0.05


def test_a_window_shows_what_is_behind_it(studio: Studio) -> None:
    camera = {"type": "perspective", "fov_y": 1.0, "pose": {"eye": [0.0, 0.0, 2.0]}}
    color = mapped(directions(studio, LATLONG, 1024, 512), "view", LATLONG)
    glass = mapped(color["texture"], "refraction", LATLONG, parameters={"ior": 1.0})

    drawn = shown(studio, {"type": "plane", "width": 9.0, "height": 9.0}, color, camera=camera)
    unbent = shown(studio, {"type": "plane", "width": 9.0, "height": 9.0}, glass, camera=camera)

    x, y = pixel_middles(64)
    rays = np.stack([x * math.tan(0.5), y * math.tan(0.5), -1 + 0 * x], axis=-1)
    rays /= np.linalg.norm(rays, axis=-1, keepdims=True)
    assert angles(drawn[..., :3], rays).max() < 0.02
    np.testing.assert_allclose(unbent, drawn, atol=1e-5)


@pytest.mark.parametrize(("turn", "ior"), [(0.6, 1.5), (0.6, 0.5), (math.pi + 0.5, 1.5)])
def test_glass_bends_by_snell_s_law(studio: Studio, turn: float, ior: float) -> None:
    picture = directions(studio, LATLONG, 1024, 512)
    color = mapped(picture, "refraction", LATLONG, parameters={"ior": ior})
    rotation = [0.0, math.sin(turn / 2), 0.0, math.cos(turn / 2)]

    drawn = shown(studio, PLANE, color, transform={"rotation": rotation})

    # The normal on the eye's side is (sin a, 0, cos a); from behind, light leaves the glass.
    inside = math.cos(turn) < 0
    angle = turn - math.pi if inside else turn
    sine = math.sin(angle) * (ior if inside else 1 / ior)
    if sine <= 1:
        bent = angle - math.asin(sine)
        wanted = [-math.sin(bent), 0.0, -math.cos(bent)]
    else:  # total reflection
        wanted = [math.sin(2 * angle), 0.0, math.cos(2 * angle)]
    assert angles(drawn[32, 32, :3], np.array(wanted)) < 0.02
