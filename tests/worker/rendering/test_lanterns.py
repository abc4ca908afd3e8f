"""T38, light colour by direction: pictures all round a point light, on the walls round it."""

import math
from typing import Any

import numpy as np
import pytest

from api_schemas.families import LayoutSpec
from api_schemas.language import FAMILIES
from tests.worker.rendering.studio import Pixels, Studio
from tests.worker.rendering.test_letters import LETTER
from tests.worker.rendering.test_wrapped_round import assert_f
from worker import layouts
from worker.layouts.cube import cells

pytestmark = pytest.mark.gl

LAMP = {"type": "point", "position": [0.3, -0.2, 0.4], "intensity": 20.0}
ROOM = {"type": "box", "width": 4.0, "height": 3.0, "depth": 5.0}
SIDES = np.array([4.0, 3.0, 5.0]) / 2
CORNERS = [[1.5, 1.2, 2.2], [-1.6, -1.1, -2.1]]  # where the eye is
SIZE = 96
VIEW = 1.8  # radians from the bottom to the top
MATT = {"technique": "phong", "diffuse_color": [1.0, 1.0, 1.0]}
BODIES: dict[str, dict[str, Any]] = {
    "latlong": {"technique": "latlong"},
    "latlong +x": {"technique": "latlong", "centre": "+x"},
    "cube": {"technique": "cube"},
    "gl cross": {"technique": "cube", "arrangement": "cross", "orientation": "gl"},
    "octahedral": {"technique": "octahedral"},
    "mirror_ball": {"technique": "mirror_ball"},
    "angular_probe": {"technique": "angular_probe"},
    "hemispheres": {"technique": "hemispheres"},
    "dual_paraboloid": {"technique": "dual_paraboloid"},
    "fisheye": {"technique": "fisheye", "angle": 2 * math.pi, "towards": "+x"},
}


def layout(name: str) -> LayoutSpec:
    body = BODIES[name]
    spec = FAMILIES["layouts"][body["technique"]].model_validate(body)
    assert isinstance(spec, LayoutSpec)
    return spec


def room(studio: Studio, eye: Any, target: Any, *lights: Any, up: Any = (0.0, 1.0, 0.0)) -> Pixels:
    """Draw the walls as the eye sees them from within; float32 (SIZE, SIZE, 3)."""
    pose = {"eye": list(eye), "target": list(target), "up": list(up)}
    camera = {"type": "perspective", "fov_y": VIEW, "near": 0.01, "pose": pose}
    nodes = [{"mesh": ROOM, "surface": MATT}]
    scene = {"camera": camera, "lights": list(lights), "nodes": nodes}
    return studio.draw(scene, (SIZE, SIZE))[..., :3]


def share(studio: Studio, eye: Any, target: Any, cookie: dict[str, Any]) -> Pixels:
    """What part of each colour comes through."""
    plain = room(studio, eye, target, LAMP)
    return room(studio, eye, target, LAMP | {"cookie": cookie}) / plain


def ways(eye: Any, target: Any) -> np.ndarray:
    """Unit vectors from the lamp to what each pixel sees; (SIZE, SIZE, 3)."""
    origin = np.array(eye)
    forward = np.array(target) - origin
    forward /= np.linalg.norm(forward)
    right = np.cross(forward, [0.0, 1.0, 0.0])
    right /= np.linalg.norm(right)
    along = ((np.arange(SIZE) + 0.5) / SIZE * 2 - 1) * math.tan(VIEW / 2)
    x, y = np.meshgrid(along, -along)
    rays = x[..., None] * right + y[..., None] * np.cross(right, forward) + forward
    # Out of a box a ray goes through the first of the three walls before it.
    steps = (np.sign(rays) * SIDES - origin) / rays
    way = origin + steps.min(axis=-1, keepdims=True) * rays - LAMP["position"]
    return np.asarray(way / np.linalg.norm(way, axis=-1, keepdims=True))


def coded(studio: Studio, name: str, height: int) -> dict[str, Any]:
    """A texture that reads, in a layout, (1 + direction) / 2."""
    spec = layout(name)
    across, down = spec.proportion
    width = height * across // down
    found, _ = layouts.direction(spec, layouts.texel_middles(width, height))
    return studio.texture((1 + found.reshape(height, width, 3)) / 2)


@pytest.mark.parametrize("eye", CORNERS)
@pytest.mark.parametrize("name", BODIES)
def test_t38_each_wall_gets_the_texel_of_its_direction(
    studio: Studio, name: str, eye: list[float]
) -> None:
    height = {"cube": 768, "gl cross": 384}.get(name, 256)
    cookie = {"texture": coded(studio, name, height), "layout": BODIES[name], "filter": "bilinear"}

    error = np.abs(2 * share(studio, eye, [0, 0, 0], cookie) - 1 - ways(eye, [0, 0, 0]))

    # A texel is about 1.4 degrees; discs have one direction for a whole rim, where they are blurred
    assert np.median(error) < 2e-3
    assert np.quantile(error, 0.98) < 0.03


def test_t38_in_openexrs_layout_x_is_a_quarter_from_the_left(studio: Studio) -> None:
    # Closed form, REFERENCE 0.3: u = 1/2 - atan2(x, z) / 2 pi, v = 1/2 + asin(y) / pi
    ramp = np.zeros((128, 256, 3))
    ramp[..., 0] = (np.arange(256) + 0.5) / 256
    ramp[..., 1] = (np.arange(128)[::-1, None] + 0.5) / 128
    cookie = {"texture": studio.texture(ramp), "filter": "bilinear"}

    for eye in CORNERS:
        seen, way = share(studio, eye, [0, 0, 0], cookie), ways(eye, [0, 0, 0])
        u = (0.5 - np.arctan2(way[..., 0], way[..., 2]) / (2 * np.pi)) % 1.0
        v = 0.5 + np.arcsin(way[..., 1]) / np.pi
        inside = (abs(u - 0.5) < 0.49) & (abs(v - 0.5) < 0.49)
        assert inside.sum() > 0.8 * SIZE**2
        np.testing.assert_allclose(seen[inside][:, 0], u[inside], atol=2e-4)
        np.testing.assert_allclose(seen[inside][:, 1], v[inside], atol=2e-4)


@pytest.mark.parametrize("face", ["+x", "-x", "+y", "-y", "+z", "-z"])
def test_t38_a_letter_on_each_side_of_a_lantern_reads_on_the_wall(
    studio: Studio, face: str
) -> None:
    spec = layout("cube")
    column, row, _ = cells(spec)[face]  # type: ignore[arg-type]
    picture = np.zeros((6 * 64, 64, 3), np.float32)
    picture[row * 64 : row * 64 + 64, column * 64 : column * 64 + 64] = LETTER
    cookie = {"texture": studio.texture(picture), "layout": BODIES["cube"]}
    axis, sign = "xyz".index(face[1]), float(face[0] + "1")
    position = np.array(LAMP["position"])
    towards = position + sign * np.eye(3)[axis]
    up = {"+y": (0.0, 0.0, 1.0), "-y": (0.0, 0.0, -1.0)}.get(face, (0.0, 1.0, 0.0))

    plain = room(studio, position, towards, LAMP, up=up)
    thrown = room(studio, position, towards, LAMP | {"cookie": cookie}, up=up)

    assert_f(thrown / plain)


def test_a_shade_turns_with_its_lamp_standing_still(studio: Studio) -> None:
    # A quarter turn about y, counter-clockwise from above, takes +z to +x
    turned = {"rotation": [0.0, 2.0, 0.0, 2.0]}  # of any length
    cookie = {"texture": coded(studio, "latlong", 256), "filter": "bilinear", **turned}
    eye = CORNERS[0]

    way = ways(eye, [0, 0, 0])
    wanted = np.stack([-way[..., 2], way[..., 1], way[..., 0]], axis=-1)
    error = np.abs(2 * share(studio, eye, [0, 0, 0], cookie) - 1 - wanted)
    assert np.median(error) < 2e-3


@pytest.mark.parametrize("filter_name", ["nearest", "bilinear", "trilinear", "anisotropic"])
@pytest.mark.parametrize("name", ["latlong", "cube", "hemispheres"])
def test_a_white_lantern_changes_nothing(studio: Studio, name: str, filter_name: str) -> None:
    white = {"technique": "constant", "value": [1.0, 1.0, 1.0]}
    cookie = {"texture": white, "layout": BODIES[name], "filter": filter_name}

    np.testing.assert_allclose(share(studio, CORNERS[0], [0, 0, 0], cookie), 1.0, atol=1e-6)


def test_fine_holes_far_away_let_through_their_mean(studio: Studio) -> None:
    checks = studio.texture(np.indices((1024, 2048)).sum(axis=0) % 2)
    far = {"type": "orthographic", "height": 3.0, "pose": {"eye": [0, 0, 2.0]}}
    nodes = [{"mesh": {"type": "plane", "width": 4.0, "height": 4.0}, "surface": MATT}]
    lamp = {"type": "point", "position": [0.0, 0.0, 1.5]}

    def drawn(light: dict[str, Any]) -> Pixels:
        return studio.draw({"camera": far, "lights": [light], "nodes": nodes}, (8, 8))[..., :3]

    np.testing.assert_allclose(
        drawn(lamp | {"cookie": {"texture": checks}}) / drawn(lamp), 0.5, atol=2e-3
    )


def test_lanterns_slides_and_shadows_add_up(studio: Studio) -> None:
    lantern = {"texture": coded(studio, "latlong", 64)}
    cube = {"texture": coded(studio, "cube", 192), "layout": BODIES["cube"], "filter": "nearest"}
    disc = {"texture": lantern["texture"], "layout": {"technique": "fisheye", "angle": 2.0}}
    spot = {"type": "spot", "position": [0.0, 0.0, 2.0], "direction": [0.2, 0.0, -1.0]}
    lights = [
        LAMP | {"cookie": cube},
        LAMP | {"cookie": lantern, "shadow": {"resolution": 64}},
        spot | {"cookie": {"texture": studio.texture([[[0.2, 0.4, 0.6]]])}},
        {"type": "ambient"},
        LAMP | {"cookie": disc},
        LAMP | {"cookie": lantern, "position": [-0.5, 0.0, 0.0]},
    ]
    eye = CORNERS[0]

    together = room(studio, eye, [0, 0, 0], *lights)

    each = [room(studio, eye, [0, 0, 0], light) for light in lights]
    np.testing.assert_allclose(together, np.sum(each, axis=0), rtol=1e-5, atol=1e-6)


def test_where_a_fisheye_does_not_look_no_light_comes_through(studio: Studio) -> None:
    # A half angle of 1 radian round -z
    ahead = {"technique": "fisheye", "angle": 2.0}
    white = studio.texture(np.ones((64, 64, 3)))
    cookie = {"texture": white, "layout": ahead, "filter": "nearest"}
    eye = CORNERS[0]

    seen = share(studio, eye, [0, 0, 0], cookie)[..., 0]

    angle = np.arccos(-ways(eye, [0, 0, 0])[..., 2])
    assert (seen[angle > 1.02] == 0).all()
    np.testing.assert_allclose(seen[angle < 0.98], 1.0, atol=1e-6)


@pytest.mark.parametrize("position", [[0.0, 0.0, 0.0], [1e6, 0.0, 0.0], [0.0, 0.0, 2.5]])
def test_a_lantern_on_a_wall_or_far_away_draws_numbers(
    studio: Studio, position: list[float]
) -> None:
    for name in ("latlong", "cube", "octahedral", "mirror_ball"):
        cookie = {"texture": coded(studio, name, 96), "layout": BODIES[name]}
        lamp = LAMP | {"position": position, "cookie": cookie}
        assert np.isfinite(room(studio, CORNERS[0], [0, 0, 0], lamp)).all()
