"""Conversion between layouts (T08): energy, constants, directions and numbers that are none."""

import numpy as np
import pytest
from pydantic import TypeAdapter

from api_schemas.members import Layout
from tests.worker.synthesis.spheres import picture, run
from worker import layouts
from worker.errors import RenderError
from worker.images.image import Image

LATLONG = {"technique": "latlong"}
WHOLE = [
    ({"technique": "latlong", "centre": "-x"}, (96, 48)),
    ({"technique": "cube"}, (24, 144)),
    ({"technique": "cube", "arrangement": "cross", "orientation": "gl"}, (96, 72)),
    ({"technique": "octahedral"}, (64, 64)),
    ({"technique": "angular_probe"}, (96, 96)),
    ({"technique": "mirror_ball"}, (96, 96)),
    ({"technique": "hemispheres"}, (128, 64)),
    ({"technique": "dual_paraboloid"}, (128, 64)),
]
SUN = np.array([0.48, 0.6, 0.64])


def sunny(d):
    return np.stack([1 + d[:, 0], 1 + d[:, 1], 0.1 + 900.0 * (d @ SUN > 0.9995)], axis=1)


def power(pixels, layout):
    spec = TypeAdapter(Layout).validate_python(layout)
    solid = layouts.solid_angles(spec, pixels.shape[1], pixels.shape[0])
    return np.einsum("hwc,hw->c", pixels.astype(np.float64), solid)


@pytest.mark.parametrize(("layout", "size"), WHOLE)
def test_no_light_is_lost_or_won(layout, size):
    image = picture(sunny, (128, 64))

    there = run({"technique": "convert_layout", "to": layout}, size, image)
    back = run({"technique": "convert_layout", "layout": layout}, (64, 32), there.image)

    before = power(image.pixels, LATLONG)
    np.testing.assert_allclose(power(there.image.pixels, layout), before, rtol=1e-3)
    np.testing.assert_allclose(power(back.image.pixels, LATLONG), before, rtol=1e-3)
    np.testing.assert_allclose(there.report["power_before"], before, rtol=1e-6)
    np.testing.assert_allclose(there.report["power_after"], before, rtol=1e-3)
    assert there.report["all_directions"]
    # what was made up for is little, even with a sun of a few texels
    np.testing.assert_allclose(there.report["gain"], 1, atol=0.05)


@pytest.mark.parametrize(("layout", "size"), WHOLE)
def test_a_constant_stays_as_it_is(layout, size):
    image = picture(lambda d: np.full((len(d), 3), [0.25, 1.0, 4.0]), (64, 32), fine=1)

    shown = run({"technique": "convert_layout", "to": layout}, size, image).image.pixels

    held = shown[..., 1] > 0
    assert held.mean() >= 0.5
    np.testing.assert_allclose(shown[held], np.broadcast_to([0.25, 1, 4], (held.sum(), 3)), 1e-5)


@pytest.mark.parametrize(("layout", "size"), WHOLE)
def test_t08_directions_stay_where_they_are(layout, size):
    # L = a + b.d, the acceptance of T08, and back: blending on a few degrees bends it by 1e-3
    b = np.array([0.3, -0.5, 0.2])
    image = picture(lambda d: 1 + d @ b, (256, 128), fine=1)

    there = run({"technique": "convert_layout", "to": layout}, size, image)

    spec = TypeAdapter(Layout).validate_python(layout)
    expected = picture(lambda d: 1 + d @ b, size, spec).pixels
    held = (expected > 0) & (there.image.pixels > 0)
    assert held.mean() >= 0.5
    np.testing.assert_allclose(there.image.pixels[held], expected[held], atol=2e-2)


def test_t08_a_fisheye_of_everything_comes_back():
    b = np.array([0.3, -0.5, 0.2])
    probe = {"technique": "angular_probe"}
    spec = TypeAdapter(Layout).validate_python(probe)
    image = picture(lambda d: 1 + d @ b, (1024, 1024), spec, fine=1)
    size = (64, 32)

    made = run({"technique": "convert_layout", "layout": probe}, size, image)

    expected = picture(lambda d: 1 + d @ b, size).pixels
    np.testing.assert_allclose(made.image.pixels, expected, atol=1e-3)
    np.testing.assert_allclose(power(made.image.pixels, LATLONG), 4 * np.pi, rtol=1e-3)


def test_the_same_layout_and_size_is_the_same_picture():
    image = picture(sunny, (32, 16))

    made = run({"technique": "convert_layout"}, (32, 16), image)

    np.testing.assert_array_equal(made.image.pixels, image.pixels)


def test_cubes_of_one_size_are_the_same_texels_elsewhere():
    column, row = {"technique": "cube"}, {"technique": "cube", "arrangement": "row"}
    image = picture(sunny, (16, 96), TypeAdapter(Layout).validate_python(column))

    made = run(
        {"technique": "convert_layout", "layout": column, "to": row}, (96, 16), image
    ).image.pixels

    faces = np.concatenate(np.split(image.pixels, 6), axis=1)
    np.testing.assert_allclose(made, faces, rtol=1e-5)


def test_bad_numbers_are_refused_on_request():
    pixels = np.ones((16, 32, 3), np.float32)
    pixels[4, 4, 1] = np.nan
    spec = {"technique": "convert_layout", "broken_texels": "refuse"}

    with pytest.raises(RenderError) as refused:
        run(spec, (8, 4), Image(pixels, "colour"))
    assert refused.value.code == "environment_texels"

    mended = run({"technique": "convert_layout"}, (8, 4), Image(pixels, "colour"))
    assert mended.report["mended_numbers"] == 1
    assert np.isfinite(mended.image.pixels).all()
    # one dark number of 512 directions: its light is missing, and nothing else
    np.testing.assert_allclose(mended.image.pixels[2:], 1, rtol=1e-5)


def test_what_is_below_zero_is_dark_and_alpha_is_left_out():
    pixels = np.full((16, 32, 4), 0.5, np.float32)
    pixels[:, :16, 0] = -3.0

    made = run({"technique": "convert_layout"}, (32, 16), Image(pixels, "colour")).image.pixels

    assert made.shape == (16, 32, 3)
    assert (made[:, :16, 0] == 0).all()
    assert (made[..., 1:] == 0.5).all()


def test_a_grey_is_three_equal_colours():
    made = run(
        {"technique": "convert_layout"}, (8, 4), Image(np.ones((4, 8, 1), np.float32), "data")
    )

    assert (made.image.pixels == 1).all()
    assert made.image.channels == 3
