"""A plane without end: T39. Rays are met with it here by hand."""

from typing import Any

import numpy as np
import pytest

from tests.worker.rendering.studio import Studio

pytestmark = pytest.mark.gl

SIZE = (48, 40)
NAMES = ["depth", "position", "uv", "normal", "geometric_normal", "tangent", "object_id"]
WHITE = {"technique": "unlit", "color": [1.0, 1.0, 1.0]}


def camera(eye: list[float], target: list[float], **more: Any) -> dict[str, Any]:
    return {"type": "perspective", "fov_y": 1.0, "pose": {"eye": eye, "target": target}} | more


def plane(surface: dict[str, Any] | None = None, **more: Any) -> dict[str, Any]:
    node = {"mesh": {"type": "infinite_plane"} | more.pop("mesh", {}), "surface": surface or WHITE}
    return node | more


def rays(seen: dict[str, Any]) -> tuple[np.ndarray, np.ndarray]:
    """Origin and direction of each pixel's ray, (h, w, 3); directions have depth 1."""
    eye, target = (np.array(seen["pose"][key], float) for key in ("eye", "target"))
    back = (eye - target) / np.linalg.norm(eye - target)
    right = np.cross([0.0, 1.0, 0.0], back)
    right /= np.linalg.norm(right)
    up = np.cross(back, right)
    width, height = SIZE
    x = ((np.arange(width) + 0.5) / width * 2 - 1) * width / height
    y = 1 - (np.arange(height) + 0.5) / height * 2
    sideways = x[None, :, None] * right + y[:, None, None] * up
    if seen["type"] == "orthographic":
        return eye + sideways * seen["height"] / 2, np.zeros_like(sideways) - back
    return eye + 0 * sideways, sideways * np.tan(seen["fov_y"] / 2) - back


VIEWS = [
    camera([0.3, 1.0, 0.2], [0.1, 0.8, -1.0]),
    camera([5e3, 700.0, -4e3], [5.1e3, 100.0, -3e3]),
    camera([0.3, -2.0, 0.2], [0.6, -1.5, -1.0]),
    {
        "type": "orthographic",
        "height": 3.0,
        "pose": {"eye": [1.0, 2.0, 3.0], "target": [0.3, 0.0, 0.1]},
    },
]


@pytest.mark.parametrize("seen", VIEWS, ids=["above", "far off", "below", "parallel"])
def test_t39_every_ray_meets_it_where_it_does(studio: Studio, seen: dict[str, Any]) -> None:
    # A turned and moved plane: u along a, v along b, one tile 2 x 0.5.
    turn = {"rotation": [0.1, 0.2, -0.1, 0.9], "translation": [0.2, -0.1, 0.4]}
    x, y, z, w = np.array(turn["rotation"]) / np.linalg.norm(turn["rotation"])
    matrix = np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
            [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
            [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
        ]
    )
    a, normal, b = matrix[:, 0], matrix[:, 1], -matrix[:, 2]
    scene = {
        "camera": seen | {"near": 1e-3, "far": 1e4},
        "nodes": [plane(transform=turn, mesh={"tile": [2.0, 0.5]})],
    }
    origin, direction = rays(seen)
    offset = origin - turn["translation"]
    with np.errstate(divide="ignore"):
        along = -(offset @ normal) / (direction @ normal)
    hit = along > 0
    point = origin + along[..., None] * direction

    drawn = studio.layers(scene, NAMES, SIZE)

    assert hit.any()
    np.testing.assert_array_equal(drawn["object_id"][..., 0], hit)
    assert (drawn["picture"][~hit] == 0).all()
    for name in NAMES:
        assert np.isfinite(drawn[name]).all(), name
    # As if the pixel were a hundred thousandth of one aside, which at the horizon is far away.
    with np.errstate(divide="ignore"):
        pixel = np.nanmax(np.abs(np.gradient(1 / along)), axis=0)
    off = abs(1 / drawn["depth"][..., 0] - 1 / along)
    assert (off <= 1e-6 / along + 1e-5 * pixel)[hit].all()
    far = np.linalg.norm(point - origin, axis=-1) * (1 + 10 * along * pixel)
    far += np.linalg.norm(origin, axis=-1)
    assert (abs(drawn["position"] - point).max(axis=-1) <= 1e-6 * far)[hit].all()
    flat = point - turn["translation"]
    uv = np.stack([flat @ a / 2.0, flat @ b / 0.5], axis=-1)
    assert (abs(drawn["uv"] - uv).max(axis=-1) <= 4e-6 * far)[hit].all()
    side = np.sign(-(direction @ normal))[hit, None]
    np.testing.assert_allclose(drawn["normal"][hit], side * normal, atol=1e-6)
    np.testing.assert_allclose(drawn["geometric_normal"][hit], side * normal, atol=1e-6)
    np.testing.assert_allclose(
        drawn["tangent"][hit], np.broadcast_to(a, flat[hit].shape), atol=1e-6
    )


def test_a_wall_has_its_picture_upright(studio: Studio) -> None:
    seen = camera([0.3, 0.2, 2.0], [0.3, 0.2, 0.0])

    drawn = studio.layers({"camera": seen, "nodes": [plane(mesh={"facing": "+z"})]}, NAMES, SIZE)

    np.testing.assert_allclose(drawn["uv"], drawn["position"][..., :2], atol=1e-6)
    assert drawn["uv"][0, 0, 1] > drawn["uv"][-1, 0, 1]


def test_near_the_eye_it_is_a_large_finite_plane(studio: Studio) -> None:
    noise = studio.texture(np.random.default_rng(2).random((64, 64, 3)))
    surface = {
        "technique": "phong",
        "diffuse_color": {"texture": noise},
        "normal": {"texture": noise, "strength": 0.5},
        "specular_weight": 0.5,
    }
    seen = camera([0.1, 1.0, 0.5], [0.1, 0.0, -0.4])
    lights = [{"type": "point", "position": [0.3, 1.0, 0.2], "intensity": 2.0}]
    finite = {
        "mesh": {"type": "plane", "facing": "+y", "width": 16.0, "height": 16.0},
        "surface": surface,
    }
    transform = {"scale": [16.0, 16.0], "offset": [-8.0, -8.0]}
    for key in ("diffuse_color", "normal"):
        surface[key] = surface[key] | {"filter": "trilinear"}
    finite["surface"] = surface | {
        key: surface[key] | {"transform": transform} for key in ("diffuse_color", "normal")
    }

    endless, bounded = (
        studio.draw({"camera": seen, "lights": lights, "nodes": [node]}, SIZE, 2)
        for node in (plane(surface), finite)
    )

    # Texel coordinates of about 8 * 64 are good to 3e-5 of a texel in float32.
    np.testing.assert_allclose(endless, bounded, atol=2e-3)


def test_it_hides_and_is_hidden_by_depth_alone(studio: Studio) -> None:
    red = {"technique": "unlit", "color": [1.0, 0.0, 0.0]}
    ball = {"mesh": {"type": "sphere"}, "surface": red}
    seen = camera([0.0, 2.0, 5.0], [0.0, 0.0, 0.0])
    for nodes in ([plane(), ball], [ball, plane()]):
        drawn = studio.layers({"camera": seen, "nodes": nodes}, ["position"], SIZE)
        red_ones = drawn["picture"][..., 1] == 0
        below = drawn["position"][..., 1] < -1e-3

        assert red_ones.any()
        assert not below.any()


@pytest.mark.parametrize("kind", ["perspective", "orthographic"])
def test_beyond_the_far_plane_the_nearer_one_is_seen(studio: Studio, kind: str) -> None:
    pose = {"eye": [0.0, 1000.0, 0.0], "target": [0.0, 999.0, -1.0]}
    seen = {"type": kind, "pose": pose, "far": 10.0}
    lower = plane({"technique": "unlit", "color": [0.0, 1.0, 0.0]})
    upper = plane(transform={"translation": [0.0, 0.5, 0.0]})
    for nodes in ([lower, upper], [upper, lower]):
        drawn = studio.layers({"camera": seen, "nodes": nodes}, ["depth"], SIZE)

        assert (drawn["picture"] == 1).all()
        assert (drawn["depth"] > 10).all()


def test_what_is_nearer_than_the_near_plane_is_not_drawn(studio: Studio) -> None:
    seen = camera([0.0, 1.0, 0.0], [0.0, 0.0, -0.01], near=1.0 + 1e-3)
    origin, direction = rays(seen)

    drawn = studio.draw({"camera": seen, "nodes": [plane()]}, SIZE)

    along = -origin[..., 1] / direction[..., 1]
    np.testing.assert_array_equal(drawn[..., 3] == 1, along >= 1.0 + 1e-3)
    assert 0 < (drawn[..., 3] == 1).mean() < 1


def test_one_side_of_it_may_be_left_out(studio: Studio) -> None:
    surface = WHITE | {"double_sided": False}
    mirrored = {"scale": [-1.0, 1.0, 1.0]}
    for transform in ({}, mirrored):
        for height, coverage in ((1.0, 1.0), (-1.0, 0.0)):
            seen = camera([0.0, height, 0.0], [0.0, 0.0, -0.1])
            nodes = [plane(surface, transform=transform)]

            drawn = studio.draw({"camera": seen, "nodes": nodes}, SIZE)

            assert (drawn[..., 3] == coverage).all(), (transform, height)


def test_edge_on_there_is_nothing(studio: Studio) -> None:
    for kind in ("perspective", "orthographic"):
        seen = {"type": kind, "pose": {"eye": [0.0, 0.0, 3.0]}}
        drawn = studio.layers({"camera": seen, "nodes": [plane()]}, NAMES, SIZE)

        assert (drawn["picture"] == 0).all()
        assert all(np.isfinite(layer).all() for layer in drawn.values())


def test_it_lets_light_through(studio: Studio) -> None:
    glass = {"technique": "unlit", "color": [0.0, 0.0, 1.0], "alpha_mode": "blend", "opacity": 0.25}
    seen = camera([0.0, 1.0, 0.0], [0.0, 0.0, -1.0])
    lower = plane({"technique": "unlit", "color": [1.0, 0.0, 0.0]})
    lower["transform"] = {"translation": [0.0, -1.0, 0.0]}

    drawn = studio.draw({"camera": seen, "nodes": [plane(glass), lower]}, SIZE)

    np.testing.assert_allclose(drawn[-1, :], np.tile([0.75, 0, 0.25, 1], (SIZE[0], 1)), atol=1e-6)


def test_tiles_of_it_make_one_picture(studio: Studio, monkeypatch: pytest.MonkeyPatch) -> None:
    from worker.rendering import renderer  # noqa: PLC0415  needs OpenGL

    noise = studio.texture(np.random.default_rng(2).random((64, 64)))
    surface = {"technique": "unlit", "color": {"texture": noise, "filter": "trilinear"}}
    scene = {"camera": VIEWS[0], "nodes": [plane(surface)]}
    whole = studio.draw(scene, SIZE)
    monkeypatch.setattr(renderer, "SAMPLES_MAX", SIZE[0] * 10)

    in_tiles = studio.draw(scene, SIZE)

    np.testing.assert_allclose(in_tiles, whole, atol=1e-3)


def test_a_framed_camera_sees_it(studio: Studio) -> None:
    drawn = studio.draw({"nodes": [plane()]}, SIZE)

    assert (drawn[SIZE[1] // 2 :, :, 3] == 1).all()
