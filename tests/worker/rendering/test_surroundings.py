"""Environments rendered from the scene itself (T23), and used on a thing in the same picture."""

import math
from typing import Any

import numpy as np
import pytest

from tests.worker.rendering.studio import Studio
from tests.worker.rendering.surroundings import (
    CHALK,
    MIRROR,
    ball_normals,
    coded,
    latlong,
    mirrored,
)

pytestmark = [pytest.mark.gl, pytest.mark.usefixtures("small_cubes")]

COLOURS = {
    "+x": [4.0, 0.0, 0.0],
    "-x": [0.0, 1.0, 1.0],
    "+y": [0.0, 2.0, 0.0],
    "-y": [1.0, 0.0, 1.0],
    "+z": [0.0, 0.0, 0.5],
    "-z": [1.0, 1.0, 0.0],
}
HALF = math.sqrt(0.5)
TURNS = {  # of a plane that faces +z, so that it faces the middle
    "+x": [0.0, -HALF, 0.0, HALF],
    "-x": [0.0, HALF, 0.0, HALF],
    "+y": [HALF, 0.0, 0.0, HALF],
    "-y": [-HALF, 0.0, 0.0, HALF],
    "+z": [0.0, 1.0, 0.0, 0.0],
    "-z": [0.0, 0.0, 0.0, 1.0],
}


def box(middle: list[float], size: float = 6.0) -> list[dict[str, Any]]:
    """Six glowing walls round a point."""
    walls = []
    for face, colour in COLOURS.items():
        place = list(middle)
        place["xyz".index(face[1])] += (0.5 if face[0] == "+" else -0.5) * size
        walls.append(
            {
                "mesh": {"type": "plane", "width": size, "height": size},
                "transform": {"translation": place, "rotation": TURNS[face]},
                "surface": {"technique": "unlit", "color": colour},
            }
        )
    return walls


LAYOUTS = pytest.mark.parametrize("layout", ["cube", "hemispheres"])


def in_the_box(studio: Studio, surface: dict[str, Any], layout: str, side: int) -> np.ndarray:
    """Draw a unit sphere in the middle of the walls, which parallel rays meet from +z."""
    middle = [5.0, -3.0, 2.0]
    eye = [middle[0], middle[1], middle[2] + 2.5]
    sphere = {
        "mesh": {"type": "sphere", "segments": 256, "rings": 128},
        "transform": {"translation": middle},
        "surface": surface,
        "surroundings": {"side": 32, "layout": layout},
    }
    pose = {"eye": eye, "target": middle}
    scene = {
        "camera": {"type": "orthographic", "height": 2.0, "pose": pose},
        "lights": [],
        "nodes": [*box(middle), sphere],
    }
    return studio.draw(scene, (side, side))


@LAYOUTS
def test_t23_a_mirror_in_a_box_shows_each_wall_where_it_is(studio: Studio, layout: str) -> None:
    seen = in_the_box(studio, MIRROR, layout, 128)

    normals, on_it = ball_normals(128)
    on_it &= np.hypot(normals[..., 0], normals[..., 1]) < 0.9
    towards = mirrored(normals)
    size = np.sort(np.abs(towards), axis=-1)
    # Not across an edge of the box: texels of 32 a quarter turn, or of 32 a radius aslant
    on_it &= size[..., 2] > (1.15 if layout == "cube" else 1.5) * size[..., 1]
    axis = np.abs(towards).argmax(axis=-1)
    for face, colour in COLOURS.items():
        positive = np.take_along_axis(towards, axis[..., None], -1)[..., 0] > 0
        there = on_it & (axis == "xyz".index(face[1])) & (positive == (face[0] == "+"))
        if face == "-z":
            assert not there.any()  # behind the ball
            continue
        expected = np.broadcast_to(colour, (there.sum(), 3))
        assert there.sum() > 100
        np.testing.assert_allclose(seen[there][:, :3], expected, atol=1e-2)


@pytest.mark.parametrize(("layout", "off"), [("cube", 0.01), ("hemispheres", 0.03)])
def test_t23_chalk_is_lit_by_the_walls(studio: Studio, layout: str, off: float) -> None:
    seen = in_the_box(studio, CHALK, layout, 65)[32, 32, :3]

    # Form factors of a cube from its middle: 2 / sqrt(2) atan(1 / sqrt(2)) 2 / pi to the wall ahead
    ahead = 4 / math.pi * HALF * math.atan(HALF)
    beside = (1 - ahead) / 4
    colours = {face: np.array(colour) for face, colour in COLOURS.items()}
    expected = ahead * colours["+z"] + beside * sum(
        colours[face] for face in ("+x", "-x", "+y", "-y")
    )
    # What the middles of 32 texels a radius miss of edges is 2.8 % of the reddest wall
    np.testing.assert_allclose(seen, expected, rtol=off)


def test_t23_it_does_not_see_itself_and_others_do_not_change(studio: Studio) -> None:
    glowing = {**CHALK, "emission": [9.0, 9.0, 9.0], "base_color": [0.0, 0.0, 0.0]}
    middle = [0.0, 0.0, 0.0]
    scene: dict[str, Any] = {
        "camera": {"type": "orthographic", "height": 2.0, "pose": {"eye": [0.0, 0.0, 2.5]}},
        "lights": [],
        "nodes": [
            *box(middle),
            {"mesh": {"type": "sphere", "radius": 0.4}, "surface": glowing},
        ],
    }
    plain = studio.draw(scene, (32, 32))
    scene["nodes"][-1]["surroundings"] = {}

    seen = studio.draw(scene, (32, 32))

    # It is matt black: what it sees adds nothing, itself included.
    np.testing.assert_allclose(seen, plain, atol=1e-5)


def test_t23_discs_hold_directions_above_and_below(studio: Studio) -> None:
    side = 64
    picture = coded(latlong(512)).astype(np.float32)
    node = {
        "mesh": {"type": "sphere", "segments": 512, "rings": 256},
        "surface": MIRROR,
        "surroundings": {"side": side, "layout": "hemispheres"},
    }
    scene = {
        "camera": {"type": "orthographic", "height": 2.0, "pose": {"eye": [0.0, 0.0, 4.0]}},
        "environment": {"texture": studio.texture(picture)},
        "nodes": [node],
    }

    seen = 2 * studio.draw(scene, (128, 128))[..., :3].astype(np.float64) - 1

    # x and z are linear on the discs, whose radius is `side` texels, and y is the height of a ball
    # over them: blends between texels miss its curvature, 1 / y^3, and the rim's last texel stands
    # for all that is lower than its middle.
    normals, on_it = ball_normals(128)
    on_it &= np.hypot(normals[..., 0], normals[..., 1]) < 0.95
    towards = mirrored(normals)
    error = np.abs(seen - towards)[on_it]
    height = np.abs(towards[..., 1])[on_it]
    texel = 1 / side
    assert error[:, [0, 2]].max() < 3 * texel
    assert error[:, 1].max() < np.sqrt(4 * texel)
    assert np.quantile(error[height > 0.5], 0.99) < texel / 2


def test_t23_what_is_far_behind_is_the_environment(studio: Studio) -> None:
    sky = np.full((16, 32, 3), [0.5, 1.0, 2.0], np.float32)
    ball = {"mesh": {"type": "sphere"}, "surface": MIRROR, "surroundings": {"side": 16}}
    scene = {
        "camera": {"type": "orthographic", "height": 2.0, "pose": {"eye": [0.0, 0.0, 4.0]}},
        "environment": {"texture": studio.texture(sky), "intensity": 0.5, "visible": False},
        "nodes": [ball],
    }

    seen = studio.draw(scene, (16, 16))

    np.testing.assert_allclose(
        seen[4:12, 4:12, :3], np.broadcast_to(0.5 * sky[0, 0], (8, 8, 3)), rtol=2e-3
    )


def test_t23_lights_shine_on_what_it_sees_from_where_they_are(studio: Studio) -> None:
    # A chalk floor under a lamp; the mirror far away sees it as the eye does
    floor = {
        "mesh": {"type": "plane", "width": 40.0, "height": 40.0},
        "transform": {"translation": [0.0, -1.0, 0.0], "rotation": [-HALF, 0.0, 0.0, HALF]},
        "surface": {"technique": "phong", "diffuse_color": [0.5, 0.5, 0.5]},
    }
    lamp = {"type": "point", "position": [0.0, 1.0, 0.0], "intensity": 8.0}
    ball = {"mesh": {"type": "sphere", "radius": 0.5}, "surface": MIRROR, "surroundings": {}}
    eye = {"type": "orthographic", "height": 1.0, "pose": {"eye": [0.0, 0.0, 9.0]}}
    scene = {"camera": eye, "lights": [lamp], "nodes": [floor, ball]}

    seen = studio.draw(scene, (129, 129))

    # Half the radius below its middle the ball mirrors upside down what lies ahead and below.
    normals, _ = ball_normals(129)
    row = 64 + round(129 / 2 * math.sin(math.radians(60)))
    way = mirrored(normals)[row, 64]
    place = -way / way[1]  # from the ball's middle to the floor
    to_lamp = np.array([0.0, 1.0, 0.0]) - place
    expected = 0.5 * 8.0 * to_lamp[1] / np.linalg.norm(to_lamp) ** 3
    assert way[1] < -0.5
    assert seen[row, 64, 0] == pytest.approx(expected, rel=3e-2)
