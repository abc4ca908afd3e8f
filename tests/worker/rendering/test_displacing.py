"""Reliefs of real triangles: heights as shaders read them, outlines that have moved (T38, T48)."""

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from api_schemas.relief import Displacement
from tests.worker.rendering.studio import Studio
from worker.errors import RenderError
from worker.geometry.mesh import Mesh
from worker.geometry.plane import plane
from worker.geometry.sphere import sphere
from worker.images.image import Image

pytestmark = pytest.mark.gl

CONSTANT = {"technique": "constant", "value": [1.0, 1.0, 1.0]}
FLAT = plane(2.0, 2.0, "+z")


def moved(mesh: Mesh, heights: Any, levels: int = 0, **how: Any) -> Mesh:
    from worker.rendering.displacing import with_relief  # noqa: PLC0415

    spec = Displacement.model_validate({"texture": CONSTANT, "depth": 1.0, **how})
    pixels = np.float32(heights)
    image = Image(pixels.reshape(*pixels.shape[:2], -1), "data")
    return with_relief(mesh, spec, levels, image)


def test_a_slope_becomes_a_slope() -> None:
    ramp = np.tile((np.arange(64) + 0.5) / 64, (4, 1))

    mesh = moved(FLAT, ramp, 3, depth=0.5, wrap=["clamp", "clamp"], filter="bilinear")

    x, y, z = mesh.positions.T
    inner = np.abs(x) < 0.98  # half a texel at the edge is flat
    np.testing.assert_allclose(z[inner], 0.25 * (x[inner] + 1), atol=1e-6)
    assert np.abs(y).max() == 1.0


def test_the_middle_stays_in_place() -> None:
    mesh = moved(FLAT, [[0.75]], depth=2.0, middle=0.25)

    np.testing.assert_allclose(mesh.positions[:, 2], 1.0)


def test_holes_are_no_heights_and_cliffs_have_an_end() -> None:
    pixels = [[np.nan, np.inf], [-np.inf, 1e38]]

    mesh = moved(FLAT, pixels, 2, filter="nearest", depth=1e6)

    assert np.isfinite(mesh.positions).all()
    assert np.abs(mesh.positions).max() <= 1e6
    np.testing.assert_allclose(np.linalg.norm(mesh.normals, axis=1), 1, atol=1e-9)


@pytest.mark.parametrize(("channel", "expected"), [("r", 0.1), ("b", 0.3), ("a", 1.0)])
def test_the_channel_that_is_asked_for_is_read(channel: str, expected: float) -> None:
    mesh = moved(FLAT, [[[0.1, 0.2, 0.3]]], channel=channel)

    np.testing.assert_allclose(mesh.positions[:, 2], expected, rtol=1e-6)


def test_detail_finer_than_the_mesh_is_its_mean() -> None:
    grain = np.random.default_rng(6).integers(0, 2, (256, 256))

    coarse = moved(FLAT, grain, 2)
    hard = moved(FLAT, grain, 2, filter="nearest")

    # An edge spans 64 texels: a mean of so many squared deviates by 1 / 2 / 64.
    assert np.abs(coarse.positions[:, 2] - 0.5).max() < 5 / 128
    assert set(np.unique(hard.positions[:, 2])) == {0.0, 1.0}


@pytest.mark.parametrize("wrap", ["repeat", "mirror", "clamp", "border"])
@pytest.mark.parametrize("filter_name", ["nearest", "bilinear"])
def test_heights_are_read_as_shaders_read_them(studio: Studio, wrap: str, filter_name: str) -> None:
    texels = np.random.default_rng(1).random((5, 7)).astype(np.float32)
    uv = np.random.default_rng(2).uniform(-2, 3, (4, 2))
    mesh = replace(FLAT, uv_sets=(uv,))
    how = {
        "wrap": [wrap, wrap],
        "filter": filter_name,
        "border_color": [0.25, 0.0, 0.0, 0.0],
    }
    turned = {"rotation": 0.4, "scale": [1.5, -0.75], "offset": [0.3, 12.8]}

    heights = moved(mesh, texels, transform=turned, **how).positions[:, 2]

    cosine, sine = np.cos(0.4), np.sin(0.4)
    places = uv * [1.5, -0.75] @ np.array([[cosine, sine], [-sine, cosine]]) + [0.3, 12.8]
    picture = studio.texture(texels)
    seen = [studio.read(picture, *place.tolist(), **how)[0] for place in places]
    # OpenGL weighs texels in steps of 1/256
    np.testing.assert_allclose(heights, seen, atol=5e-3 if filter_name == "bilinear" else 1e-7)


def test_without_coordinates_there_is_nothing_to_read() -> None:
    with pytest.raises(RenderError) as caught:
        moved(replace(FLAT, uv_sets=()), [[1.0]])

    assert caught.value.code == "coordinates_missing"


@pytest.mark.parametrize("kind", ["lines", "points"])
def test_lines_and_points_are_left_alone(kind: Any) -> None:
    mesh = replace(FLAT, kind=kind, uv_sets=())

    assert moved(mesh, [[1.0]], 3) is mesh


def test_t48_heights_within_the_noise_bound_keep_a_ball_within_it() -> None:
    # |p'| lies within 1 +- A sup|noise|, whatever the heights of magnitude 1.0364
    noise = np.random.default_rng(3).uniform(-1.0364, 1.0364, (64, 128))

    radii = np.linalg.norm(
        moved(sphere(1.0, 64, 32), noise, 1, depth=0.25, filter="bilinear").positions, axis=1
    )

    chord = np.cos(np.pi / 64) * np.cos(np.pi / 64)  # middles of edges lie below the ball
    assert radii.max() <= 1 + 0.25 * 1.0364
    assert radii.min() >= chord - 0.25 * 1.0364


def ball(**displacement: Any) -> dict[str, Any]:
    return {
        "camera": {"type": "orthographic", "height": 4.0, "pose": {"eye": [0.0, 0.0, 5.0]}},
        "nodes": [
            {
                "mesh": {"type": "sphere", "segments": 128, "rings": 64},
                "displacement": {"texture": CONSTANT, **displacement},
            }
        ],
    }


def test_the_outline_is_that_of_what_has_moved(studio: Studio) -> None:
    seen = studio.draw(ball(depth=0.5, subdivisions=0), (128, 128))[..., 3]

    # pi 1.5^2 of 16 square units
    assert seen.mean() == pytest.approx(np.pi * 2.25 / 16, rel=5e-3)


def test_a_relief_without_depth_changes_no_pixel(studio: Studio) -> None:
    flat = ball(depth=0.0, subdivisions=0)
    plain = ball(depth=0.0, subdivisions=0)
    del plain["nodes"][0]["displacement"]

    np.testing.assert_array_equal(studio.draw(flat), studio.draw(plain))


def test_an_eye_that_frames_everything_frames_what_has_moved(studio: Studio) -> None:
    scene = ball(depth=3.0, subdivisions=0) | {"camera": {"type": "framed"}}

    seen = studio.draw(scene, (64, 64))[..., 3]

    assert seen[0].sum() == seen[-1].sum() == seen[:, 0].sum() == seen[:, -1].sum() == 0
    assert seen.mean() > 0.4


def test_too_many_triangles_are_refused_before_they_are_made(studio: Studio) -> None:
    with pytest.raises(RenderError) as caught:
        studio.draw(ball(subdivisions=10))

    assert caught.value.code == "over_budget"


def test_one_mesh_in_two_reliefs_is_two_meshes(studio: Studio) -> None:
    small, large = (studio.draw(ball(depth=depth, subdivisions=0)) for depth in (0.1, 0.9))

    assert large[..., 3].sum() > 1.5 * small[..., 3].sum()


NOISE = {"technique": "perlin", "frequency": 4, "range": "signed", "gradients": "reference"}
IN_SPACE = {"coordinates": {"technique": "position"}, "transform": {"scale": [1.0, 1.0]}}


def test_t48_a_ball_moved_by_solid_noise_stays_within_its_bound(studio: Studio) -> None:
    amplitude = 0.25
    scene = ball(depth=amplitude, subdivisions=1, **IN_SPACE)
    scene["nodes"][0]["displacement"]["texture"] = NOISE

    layers = studio.layers(scene, ["position", "coverage"], (96, 96))

    seen = layers["coverage"][..., 0] == 1
    radii = np.linalg.norm(layers["position"][seen], axis=1)
    assert radii.max() <= 1 + 1.0364 * amplitude
    assert radii.min() >= np.cos(np.pi / 128) ** 2 - 1.0364 * amplitude
    assert radii.std() > 0.1 * amplitude


def test_t48_where_space_goes_on_a_solid_relief_has_no_seam(studio: Studio) -> None:
    # Read by uv, noise jumps where u begins; in space nothing begins on a ball.
    from worker.rendering.displacing import relief_of, with_relief  # noqa: PLC0415

    spec = Displacement.model_validate({"texture": NOISE, "depth": 0.3, **IN_SPACE})
    volume = relief_of(spec, studio.maker)
    fine = sphere(1.0, 256, 128)

    moved_ball = with_relief(fine, spec, 0, volume)

    # Neighbours differ by no more than noise is steep: 4 cells, less than 3 each
    places = moved_ball.positions[moved_ball.triangles]
    edges = np.linalg.norm(places - np.roll(places, 1, axis=1), axis=2)
    assert edges.max() < np.pi / 128 * (1 + 0.3 * 4 * 3)


def test_a_solid_relief_turns_with_its_mesh(studio: Studio) -> None:
    scene = ball(depth=0.3, subdivisions=0, **IN_SPACE)
    scene["nodes"][0]["displacement"]["texture"] = NOISE
    quarter = {"rotation": [0.0, 0.0, np.sqrt(0.5), np.sqrt(0.5)]}

    still = studio.draw(scene, (64, 64))[..., 3]
    scene["nodes"][0]["transform"] = quarter
    turned = studio.draw(scene, (64, 64))[..., 3]

    assert (np.rot90(still) != turned).mean() < 2e-3
