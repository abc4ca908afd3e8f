"""Normals of reliefs whose slopes are known."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from api_schemas.textures.constant import ConstantSpec
from api_schemas.textures.normal_from_height import NormalFromHeightSpec
from worker.images.image import Image
from worker.stages import silent
from worker.synthesis.normal_from_height import synthesize

NUMBERS = st.floats(-(2.0**127), 2.0**127, width=32)


def normals(heights, **fields):
    nothing = ConstantSpec(technique="constant", value=0.0)
    spec = NormalFromHeightSpec(
        technique="normal_from_height", height=nothing, **{"range": "signed", **fields}
    )
    relief = np.array(heights, np.float32)[..., np.newaxis]
    relief.flags.writeable = False
    image = synthesize(spec, heights.shape[::-1], {"height": Image(relief, "data")}, silent)
    assert image.meaning == "data"
    return image.pixels


def centres(width, height):
    return np.meshgrid((np.arange(width) + 0.5) / width, 1 - (np.arange(height) + 0.5) / height)


def test_a_sine_relief_has_the_normal_of_t12():
    u, v = centres(260, 260)

    found = normals(np.sin(2 * np.pi * u) * np.sin(2 * np.pi * v), depth=0.05)

    # u = v = 1/8 in column 32 and row 227. Differences over two texels see the slope of a sine
    # (2 pi / 260)^2 / 6 = 1e-4 too small: 1.5e-5 of a component of .153
    assert (u[227, 32], v[227, 32]) == (0.125, 0.125)
    assert found[227, 32] == pytest.approx([-0.153341640, -0.153341640, 0.976203200], abs=2e-5)


def test_up_is_v_and_right_is_u():
    u, v = centres(64, 64)

    # Midway the hills sin^2 rise to the right and upwards: normals lean to the left and down
    right = normals(np.sin(np.pi * u) ** 2)[32, 16]
    up = normals(np.sin(np.pi * v) ** 2)[47, 32]

    assert right[0] < -0.1
    assert right[1] == 0
    assert up[1] < -0.1
    assert up[0] == 0


def test_a_flat_relief_points_straight_out():
    assert (normals(np.full((3, 5), 7.0)) == [0, 0, 1]).all()
    assert (normals(np.full((3, 5), 7.0), range="unit") == [0.5, 0.5, 1]).all()
    assert (normals(np.arange(6.0).reshape(2, 3), depth=0.0) == [0, 0, 1]).all()


def test_negative_depth_turns_bumps_into_dents():
    relief = np.random.default_rng(0).random((9, 8))

    bumps, dents = normals(relief, depth=0.1), normals(relief, depth=-0.1)

    assert (bumps[..., :2] == -dents[..., :2]).all()
    assert (bumps[..., 2] == dents[..., 2]).all()


def test_the_tile_goes_on_around_its_edges():
    relief = np.random.default_rng(1).random((10, 16))

    moved = normals(np.roll(relief, (3, 5), (0, 1)))

    assert moved.tobytes() == np.roll(normals(relief), (3, 5), (0, 1)).tobytes()


@given(st.lists(NUMBERS, min_size=6, max_size=6), st.floats(-16, 16))
def test_every_normal_has_length_one_and_points_outwards(values, depth):
    found = normals(np.float32(values).reshape(2, 3), depth=depth).astype(np.float64)

    assert np.linalg.norm(found, axis=-1) == pytest.approx(1, abs=2e-7)
    assert (found[..., 2] >= 0).all()


def test_pixels_do_not_depend_on_the_number_of_threads(with_threads):
    relief = np.random.default_rng(2).random((90, 150))

    one = with_threads(1, lambda: normals(relief))
    two = with_threads(2, lambda: normals(relief))

    assert one.tobytes() == two.tobytes()
