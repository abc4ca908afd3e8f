"""X19: a set of maps from one relief, each against a shape whose answer is known (X07)."""

import numpy as np
import pytest
from pydantic import TypeAdapter

from api_schemas.members import Texture
from tests.run_example import run_example
from tests.worker.images.exr_bytes import parse_exr
from worker.images.image import Image
from worker.synthesis import outcome
from worker.synthesis._horizons import sky_seen

ASSET = {"technique": "image", "asset": "0" * 64}
UP = np.float64([0, 0, 1])


def maps(heights, **fields):
    body = {"technique": "material_from_height", "height": ASSET, **fields}
    picture = Image(heights.astype(np.float32)[..., np.newaxis], "data")
    size = heights.shape[1], heights.shape[0]
    return outcome(TypeAdapter(Texture).validate_python(body), size, lambda *_: picture)


def centres(side):
    middle = (np.arange(side) + 0.5) / side
    return np.meshgrid(middle, 1 - middle)


def test_a_flat_relief_sees_all_of_the_sky_and_has_no_curvature():
    made = maps(np.full((12, 20), 0.5), cavity=1.0)

    assert made.layers["occlusion"].pixels == pytest.approx(1, abs=1e-6)
    assert (made.layers["normal"].pixels == [0, 0, 1]).all()
    assert (made.layers["curvature"].pixels == 0.5).all()
    assert made.layers["roughness"].pixels == pytest.approx(0.7, abs=1e-6)
    assert made.image.pixels[0, 0] == pytest.approx([0.24, 0.2025, 0.1675], abs=1e-6)
    assert made.image.meaning == "colour"


@pytest.mark.parametrize("distance", [10, 20])
def test_x07_at_the_foot_of_a_wall_half_of_one_and_its_cosine_is_seen(distance):
    # A plateau of a quarter of the tile, 20 texels high; the far side is beyond reach
    relief = np.zeros((256, 256))
    relief[:, :64] = 20 / 256

    seen = sky_seen(relief, np.broadcast_to(UP, (256, 256, 3)).copy(), 0.35)

    # (1 + cos(atan(h / d))) / 2 for an endless wall; 16 directions and what lies beyond the reach
    # of 90 texels, where the wall's horizon is below 13 degrees, are worth a hundredth
    expected = (1 + np.cos(np.arctan(20 / distance))) / 2
    assert seen[128, 63 + distance] == pytest.approx(expected, abs=0.015)


def test_on_a_slope_that_never_ends_all_that_is_before_it_is_seen():
    # Nothing stands out of the plane: the half of directions before it is all there is
    relief = np.tile((np.arange(256) - 128) / 256.0, (256, 1))
    normals = np.broadcast_to(np.float64([-1, 0, 1]) / np.sqrt(2), (256, 256, 3)).copy()

    seen = sky_seen(relief, normals, 0.2)

    assert seen[128, 128] == pytest.approx(1, abs=1e-9)


def test_x07_a_ball_is_as_curved_as_one_over_its_radius():
    u, v = centres(256)
    square = (u - 0.5) ** 2 + (v - 0.5) ** 2
    ball = np.sqrt(np.maximum(0.3**2 - square, 0))

    peak = maps(ball, depth=1.0, curvature_radius=0.1)
    pit = maps(-ball, depth=1.0, curvature_radius=0.1)

    # 0.5 + 0.5 x 0.1 / 0.3; differences over a texel see it a ten-thousandth off
    middle = np.s_[118:138, 118:138]
    assert peak.layers["curvature"].pixels[middle] == pytest.approx(0.5 + 0.05 / 0.3, abs=5e-4)
    assert pit.layers["curvature"].pixels[middle] == pytest.approx(0.5 - 0.05 / 0.3, abs=5e-4)


def test_normals_are_those_of_the_slopes_with_v_up():
    u, v = centres(64)
    made = maps(np.sin(2 * np.pi * (u + v)), depth=0.1)

    normal = made.layers["normal"].pixels.astype(np.float64)
    slope = 0.2 * np.pi * np.cos(2 * np.pi * (u + v))

    assert np.linalg.norm(normal, axis=-1) == pytest.approx(1, abs=1e-6)
    # Central differences see sin(k) / k of a wave of k = 2 pi / 64: 1.6e-3 less
    assert -normal[..., 0] / normal[..., 2] == pytest.approx(slope, abs=2e-3)
    assert -normal[..., 1] / normal[..., 2] == pytest.approx(slope, abs=2e-3)


def test_every_layer_tiles_and_lies_within_its_bounds():
    relief = np.random.default_rng(0).random((40, 48))

    made, moved = maps(relief), maps(np.roll(relief, (7, 30), (0, 1)))

    for name, layer in made.layers.items():
        assert moved.layers[name].pixels == pytest.approx(
            np.roll(layer.pixels, (7, 30), (0, 1)), abs=1e-5
        )
        assert np.abs(layer.pixels).max() <= 1
    assert (made.layers["height"].pixels[..., 0] == relief.astype(np.float32)).all()


def test_pixels_do_not_depend_on_the_number_of_threads(with_threads):
    relief = np.random.default_rng(1).random((50, 60))

    one = with_threads(1, lambda: maps(relief).image.pixels.tobytes())
    two = with_threads(2, lambda: maps(relief).image.pixels.tobytes())

    assert one == two


def test_reliefs_without_bounds_or_numbers_end_nothing():
    relief = np.array([[np.nan, np.inf], [-np.inf, 3e38]])

    made = maps(relief, depth=1.0)

    assert all(np.isfinite(layer.pixels).all() for layer in made.layers.values())
    assert np.isfinite(made.image.pixels).all()


def test_x19_one_request_makes_a_set_that_tiles(tmp_path):
    out = tmp_path / "set.exr"

    run_example("material_from_height", out, tmp_path, format="exr", exr_type="float")

    channels = parse_exr(out.read_bytes()).channels
    maps = {name.partition(".")[0] for name in channels}
    assert maps >= {"R", "height", "N", "occlusion", "curvature", "roughness"}
    for name, values in channels.items():
        for axis in (0, 1):
            # Where its edges join it is about as rough as along the roughest line within
            seam = np.abs(np.take(values, 0, axis) - np.take(values, -1, axis)).mean()
            inside = np.abs(np.diff(values, axis=axis)).mean(axis=1 - axis)
            assert seam <= 1.2 * inside.max() + 1e-6, name
