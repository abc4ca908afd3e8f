"""scene.environment: mirrors (T07), rough ones (T35, X17), chalk (T36, T37), what is behind."""

from typing import Any

import numpy as np
import pytest

from tests.worker.rendering.studio import Studio
from tests.worker.rendering.surroundings import (
    BALL_CAMERA,
    CHALK,
    MIRROR,
    ball,
    ball_normals,
    coded,
    latlong,
    mirrored,
)
from worker.errors import RenderError

pytestmark = [pytest.mark.gl, pytest.mark.usefixtures("small_cubes")]


GREY = np.full((32, 64, 3), [0.25, 0.5, 2.0], np.float32)


def angle(seen: np.ndarray, expected: np.ndarray) -> np.ndarray:
    """Degrees between coded and true directions."""
    found = 2 * seen[..., :3].astype(np.float64) - 1
    across = np.linalg.norm(np.cross(found, expected), axis=-1)
    return np.degrees(np.arctan2(across, (found * expected).sum(axis=-1)))


def test_t07_a_mirror_shows_the_direction_it_reflects(studio: Studio) -> None:
    side = 512
    picture = studio.texture(coded(latlong(2048)).astype(np.float32))

    seen = ball(studio, {"texture": picture}, MIRROR, side)

    normals, on_it = ball_normals(side)
    radius = np.hypot(normals[..., 0], normals[..., 1])
    error = angle(seen, mirrored(normals))
    on_it &= radius < 1 - 2 / side  # pixels across the silhouette are of two things
    assert error[on_it].max() < 0.12
    assert error[radius < 0.9].max() < 0.03


@pytest.mark.parametrize("centre", ["+z", "+x", "-z", "-x"])
def test_t07_the_middle_of_the_picture_is_where_its_layout_says(
    studio: Studio, centre: str
) -> None:
    turns = {"+z": 0.0, "+x": 0.25, "-z": 0.5, "-x": 0.75}
    # The picture's columns are moved so that the direction is in its middle.
    picture = np.roll(coded(latlong(256)), round(256 * turns[centre]), axis=1)
    environment = {
        "texture": studio.texture(picture.astype(np.float32)),
        "layout": {"technique": "latlong", "centre": centre},
    }

    seen = ball(studio, environment, MIRROR, 128)

    normals, on_it = ball_normals(128)
    on_it &= np.hypot(normals[..., 0], normals[..., 1]) < 0.8
    assert angle(seen, mirrored(normals))[on_it].max() < 0.5


def test_it_turns_counter_clockwise_as_seen_from_above(studio: Studio) -> None:
    picture = studio.texture(coded(latlong(256)).astype(np.float32))
    turn = 0.7

    seen = ball(studio, {"texture": picture, "rotation_y": turn}, MIRROR, 128)

    # What was towards +z is now turn round y from it, towards +x.
    normals, on_it = ball_normals(128)
    x, y, z = np.moveaxis(mirrored(normals), -1, 0)
    c, s = np.cos(turn), np.sin(turn)
    unturned = np.stack([c * x - s * z, y, s * x + c * z], axis=-1)
    on_it &= np.hypot(normals[..., 0], normals[..., 1]) < 0.8
    assert angle(seen, unturned)[on_it].max() < 0.5


@pytest.mark.parametrize("layout", ["latlong", "octahedral"])
@pytest.mark.parametrize("roughness", [0.0, 0.1, 0.35, 0.7, 1.0])
def test_the_furnace_stays_constant(studio: Studio, roughness: float, layout: str) -> None:
    square = GREY[:, :32] if layout == "octahedral" else GREY
    environment = {"texture": studio.texture(square), "layout": {"technique": layout}}
    surface = {**MIRROR, "roughness": roughness, "energy_compensation": True}

    seen = ball(studio, environment, surface, 24)

    normals, _ = ball_normals(24)
    on_it = np.hypot(normals[..., 0], normals[..., 1]) < 0.9
    # within what the table of split sums leaves of energy
    np.testing.assert_allclose(
        seen[on_it][:, :3], np.broadcast_to(GREY[0, 0], (on_it.sum(), 3)), rtol=6e-3
    )


def test_the_furnace_keeps_chalk_and_phong(studio: Studio) -> None:
    environment = {"texture": studio.texture(GREY), "intensity": 2.0}
    white = {"technique": "phong", "diffuse_color": [1.0, 1.0, 1.0]}

    for surface in (CHALK, white):
        seen = ball(studio, environment, surface, 16)
        np.testing.assert_allclose(
            seen[8, 4:12, :3], np.broadcast_to(2 * GREY[0, 0], (8, 3)), rtol=1e-3
        )


@pytest.mark.parametrize("matt", ["sum", "harmonics"])
def test_t36_chalk_shows_irradiance_over_pi(studio: Studio, matt: str) -> None:
    sky = (latlong(128)[..., 1] > 0).astype(np.float32)

    seen = ball(studio, {"texture": studio.texture(sky), "matt": matt}, CHALK, 32)

    normals, on_it = ball_normals(32)
    on_it &= np.hypot(normals[..., 0], normals[..., 1]) < 0.95
    # E / pi of half a sky is (1 + n.y) / 2, for nine harmonics too
    expected = (1 + normals[..., 1]) / 2
    np.testing.assert_allclose(seen[on_it][:, 1], expected[on_it], atol=6e-3)


def test_it_is_seen_behind_everything_in_perspective(studio: Studio) -> None:
    picture = studio.texture(coded(latlong(2048)).astype(np.float32))
    eye, target = np.array([1.0, 2.0, 3.0]), np.array([-2.0, 2.5, -1.0])
    camera: dict[str, Any] = {
        "type": "perspective",
        "fov_y": 1.2,
        "pose": {"eye": eye.tolist(), "target": target.tolist()},
    }

    scene = {"camera": camera, "environment": {"texture": picture}, "nodes": []}
    seen = studio.draw(scene, (48, 32), 2)

    forward = (target - eye) / np.linalg.norm(target - eye)
    right = np.cross(forward, [0, 1, 0])
    right /= np.linalg.norm(right)
    up = np.cross(right, forward)
    x, y = np.meshgrid((2 * np.arange(48) + 1) / 48 - 1, 1 - (2 * np.arange(32) + 1) / 32)
    slope = np.tan(0.6)
    rays = forward + (x * 1.5 * slope)[..., None] * right + (y * slope)[..., None] * up
    rays /= np.linalg.norm(rays, axis=-1, keepdims=True)
    assert angle(seen, rays).max() < 0.1
    assert (seen[..., 3] == 1).all()


def test_parallel_rays_see_one_direction_of_it(studio: Studio) -> None:
    picture = studio.texture(coded(latlong(512)).astype(np.float32))
    scene = {"camera": BALL_CAMERA, "environment": {"texture": picture}, "nodes": []}

    seen = studio.draw(scene, (8, 8))

    assert angle(seen, np.array([0.0, 0.0, -1.0])).max() < 0.1


def test_in_tiles_it_is_the_same_to_a_hair(studio: Studio, monkeypatch: pytest.MonkeyPatch) -> None:
    from worker.rendering import renderer  # noqa: PLC0415  needs OpenGL

    picture = studio.texture(coded(latlong(256)).astype(np.float32))
    scene = {
        "camera": {"type": "perspective", "pose": {"eye": [0.0, 0.0, 3.0]}},
        "environment": {"texture": picture},
        "nodes": [{"mesh": {"type": "sphere"}, "surface": MIRROR}],
    }
    whole = studio.draw(scene, (90, 70))
    monkeypatch.setattr(renderer, "SAMPLES_MAX", 90 * 8)

    cut = studio.draw(scene, (90, 70))

    np.testing.assert_allclose(cut, whole, atol=2e-5)


def test_a_background_hides_it_and_so_does_not_being_visible(studio: Studio) -> None:
    environment = {"texture": studio.texture(GREY)}
    scene: dict[str, Any] = {"camera": BALL_CAMERA, "nodes": []}

    hidden = studio.draw({**scene, "environment": {**environment, "visible": False}}, (4, 4))
    covered = studio.draw(
        {**scene, "environment": environment, "background": [0.1, 0.2, 0.3]}, (4, 4)
    )

    assert (hidden == 0).all()
    np.testing.assert_allclose(covered[0, 0], [0.1, 0.2, 0.3, 1.0], rtol=1e-6)


def test_layers_know_nothing_of_what_is_behind(studio: Studio) -> None:
    scene = {
        "camera": BALL_CAMERA,
        "environment": {"texture": studio.texture(GREY)},
        "nodes": [{"mesh": {"type": "disk", "radius": 0.5}}],
    }

    layers = studio.layers(scene, ["depth", "coverage"], (8, 8))

    assert layers["coverage"][0, 0, 0] == 0
    assert layers["depth"][0, 0, 0] == np.float32(1e10)
    np.testing.assert_allclose(layers["picture"][0, 0, :3], GREY[0, 0], rtol=1e-5)


def test_lights_that_nobody_named_are_not_added(studio: Studio) -> None:
    environment = {"texture": studio.texture(np.zeros((8, 16, 3))), "visible": False}
    chalk = {"technique": "phong", "diffuse_color": [1.0, 1.0, 1.0]}

    assert not ball(studio, environment, chalk, 8)[..., :3].any()


def test_numbers_that_are_none_do_not_spread(studio: Studio) -> None:
    pixels = np.ones((32, 64, 3), np.float32)
    pixels[4, 5], pixels[20, 40, 1] = np.nan, np.inf

    for roughness in (0.0, 0.5):
        surface = {**MIRROR, "roughness": roughness}
        seen = ball(studio, {"texture": studio.texture(pixels)}, surface, 16)
        assert np.isfinite(seen).all()
        assert seen[..., :3].max() <= 1 + 1e-3
        # Rough metal gives back 69 % without the light between facets, and 2 of 2048 are dark.
        assert np.median(seen[4:12, 4:12, :3]) > 0.85


@pytest.mark.parametrize(("bad", "count"), [(np.nan, 1), (np.inf, 1), (-np.inf, 1), (1.0, 0)])
@pytest.mark.parametrize("layout", ["latlong", "octahedral"])
def test_numbers_that_are_none_are_refused_where_that_is_wished(
    studio: Studio, layout: str, bad: float, count: int
) -> None:
    pixels = np.ones((16, 32 if layout == "latlong" else 16, 3), np.float32)
    pixels[4, 5, 1] = bad
    environment = {
        "texture": studio.texture(pixels),
        "layout": {"technique": layout},
        "broken_texels": "refuse",
    }

    if not count:
        assert np.isfinite(ball(studio, environment, MIRROR, 4)).all()
        return
    with pytest.raises(RenderError, match=r"^1 number") as refused:
        ball(studio, environment, MIRROR, 4)
    assert refused.value.code == "environment_texels"
    assert refused.value.pointer == "/scene/environment/texture"
