"""What a normal map's slopes tell of it (T66), and fields that no relief has."""

import numpy as np
import pytest

from api_schemas.textures.normal_map_doctor import NormalMapDoctorSpec
from worker.images.image import Image
from worker.stages import silent
from worker.synthesis.height_from_normal import integrated
from worker.synthesis.normal_map_doctor import circulation, curl, synthesize

ASSET = {"technique": "image", "asset": "0" * 64}


def tile(side=256):
    centres = (np.arange(side) + 0.5) / side
    return np.meshgrid(centres, centres[::-1])


def normals_of(slope_u, slope_v):
    normals = np.stack([-slope_u, -slope_v, np.ones_like(slope_u)], axis=-1)
    return normals / np.linalg.norm(normals, axis=-1, keepdims=True)


def examined(normals, **fields):
    body = {"technique": "normal_map_doctor", "normal": ASSET, "normal_range": "signed", **fields}
    spec = NormalMapDoctorSpec.model_validate(body)
    image = Image(np.float32(normals), "data")
    return synthesize(spec, (image.width, image.height), {"normal": image}, silent)


def hills(side=256, height=0.05):
    """Slopes of height sin(2 pi u) sin(2 pi v)."""
    u, v = (2 * np.pi * place for place in tile(side))
    steep = 2 * np.pi * height
    return steep * np.cos(u) * np.sin(v), steep * np.sin(u) * np.cos(v)


def as_bytes(normals):
    return np.rint((normals / 2 + 0.5) * 255) / 255


def test_a14_the_field_of_the_exercise_climbs_round_the_circle():
    # n = S(-z, 1, x) on the disc: the slopes of y are z along x and -x along z
    angle = 2 * np.pi * np.arange(2000) / 2000
    circle = np.stack([np.cos(angle), np.sin(angle)], axis=1)
    between = (circle + np.roll(circle, -1, axis=0)) / 2

    climbed = circulation(np.stack([between[:, 1], -between[:, 0]], axis=1), circle)

    assert climbed == pytest.approx(-6.283174972, abs=1e-9)  # of the polygon with 2000 corners
    assert climbed == pytest.approx(-2 * np.pi, abs=2e-5)


def test_a14_its_curl_is_minus_two_everywhere():
    # On a grid of 256 x 256 over -1..1: a tile is two units wide
    u, v = tile()
    x, z = 2 * u - 1, 2 * v - 1

    found = curl(z, -x)[1:-1, 1:-1] / 2

    assert found == pytest.approx(np.full((254, 254), -2), abs=1e-9)


def test_a14_a_swirl_is_no_relief_at_all():
    u, v = tile()

    lacking = integrated(0.3 * np.sin(2 * np.pi * v), -0.3 * np.sin(2 * np.pi * u))[1]

    assert lacking == pytest.approx(1, abs=1e-6)


def test_the_exercise_on_a_tile_is_told_with_its_circulation():
    u, v = tile()
    x, z = 4 * u - 2, 4 * v - 2  # the unit circle has a radius of a quarter of the tile

    told = examined(normals_of(z, -x), loop_radius=0.25).report

    # In tiles, four units each. Blending texels keeps a linear field; float32 rounds it.
    assert 4 * told["circulation"] == pytest.approx(-6.283174972, abs=1e-5)
    assert told["not_integrable"] > 0.5


def test_a_relief_has_no_curl_and_is_found_again():
    slope_u, slope_v = hills()

    outcome = examined(normals_of(slope_u, slope_v))

    told = outcome.report
    assert told["not_integrable"] < 1e-12
    assert abs(told["circulation"]) < 1e-6
    assert told["curl"]["rms"] < 1e-4  # float32: 1e-7 of a slope, over two texels of 1/256
    u, v = tile()
    height = 0.05 * np.sin(2 * np.pi * u) * np.sin(2 * np.pi * v)
    assert outcome.layers["height"].pixels[..., 0] == pytest.approx(height, abs=1e-7)
    assert outcome.layers["residual"].pixels.max() < 1e-5


def test_eight_bits_are_the_floor_of_the_reference():
    normals = as_bytes(normals_of(*hills()))

    outcome = examined(normals, normal_range="unit")

    assert outcome.report["not_integrable"] == pytest.approx(1.0515e-4, rel=1e-3)
    u, v = tile()
    height = 0.05 * np.sin(2 * np.pi * u) * np.sin(2 * np.pi * v)
    error = outcome.layers["height"].pixels[..., 0] - height
    assert np.sqrt((error**2).mean() / (height**2).mean()) == pytest.approx(0.0004, abs=3e-5)


@pytest.mark.parametrize("flipped", [False, True])
@pytest.mark.parametrize("said", ["up", "down"])
def test_a_flipped_green_is_found_whatever_was_said(flipped, said):
    slope_u, slope_v = hills(64)
    held = normals_of(slope_u, -slope_v if flipped else slope_v)

    told = examined(as_bytes(held), normal_range="unit", green=said).report

    assert told["green"] == ("as_said" if flipped == (said == "down") else "flipped")
    # With green flipped, slopes of waves (1, 1) lie across them: nothing of them is a relief's
    assert max(told["not_integrable"], told["not_integrable_flipped"]) > 0.9


@pytest.mark.parametrize("slopes", ["flat", "waves along u", "noise"])
def test_where_nothing_can_be_told_nothing_is_said(slopes):
    u, _ = tile(64)
    random = np.random.default_rng(4)
    found = {
        "flat": (0 * u, 0 * u),
        "waves along u": (0.3 * np.cos(2 * np.pi * u), 0 * u),
        "noise": (random.normal(size=u.shape), random.normal(size=u.shape)),
    }[slopes]

    assert examined(normals_of(*found)).report["green"] == "cannot_tell"


def test_the_picture_holds_the_normals_of_the_nearest_relief():
    slope_u, slope_v = hills(64)
    u, v = tile(64)
    whirl = 0.2 * np.sin(2 * np.pi * v), -0.2 * np.sin(2 * np.pi * u)

    mended = examined(normals_of(slope_u + whirl[0], slope_v + whirl[1]), range="signed")
    packed = examined(normals_of(slope_u, slope_v))

    assert mended.image.pixels == pytest.approx(normals_of(slope_u, slope_v), abs=1e-6)
    assert packed.image.pixels == pytest.approx(normals_of(slope_u, slope_v) / 2 + 0.5, abs=1e-6)
    residual = mended.layers["residual"].pixels[..., 0]
    assert residual == pytest.approx(np.hypot(*whirl), abs=1e-6)


def test_lengths_and_sides_are_told():
    normals = np.tile(np.float32([0, 0, 1]), (4, 4, 1))
    normals[0, 0], normals[1, 1] = [0, 0, -0.5], [0, 0, 3]

    told = examined(normals).report

    assert told["length"] == {"least": 0.5, "mean": pytest.approx(17.5 / 16), "largest": 3.0}
    assert told["not_upwards"] == pytest.approx(1 / 16)


@pytest.mark.parametrize("held", [0.0, np.nan, np.inf, -np.inf, 3e38])
@pytest.mark.parametrize("channels", [1, 2, 3, 4])
def test_no_picture_ends_it(held, channels):
    pixels = np.full((5, 3, channels), 0.5)
    pixels[2, 1] = held

    outcome = examined(pixels, normal_range="unit")

    assert np.isfinite(outcome.image.pixels).all()
    assert all(np.isfinite(layer.pixels).all() for layer in outcome.layers.values())
    assert np.isfinite(outcome.report["curl"]["rms"])
