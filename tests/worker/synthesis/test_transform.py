"""Textures moved, turned and repeated, against arrays rolled, turned and tiled."""

import numpy as np
import pytest

from worker.images.image import Image

ASSET = {"technique": "image", "asset": "0" * 64}
NOISE = np.random.default_rng(0).random((12, 16, 3)).astype(np.float32)
SQUARE = NOISE[:, :12]


def transformed(make, pixels, **fields):
    body = {"technique": "transform", "input": ASSET, **fields}
    size = pixels.shape[1], pixels.shape[0]
    return make(body, size, lambda spec, meaning: Image(pixels, meaning))


def test_nothing_asked_nothing_changes(make):
    assert transformed(make, NOISE).tobytes() == NOISE.tobytes()
    assert transformed(make, NOISE, offset=[3.0, -2.0]).tobytes() == NOISE.tobytes()


def test_a_shift_of_coordinates_brings_what_lies_right_and_above(make):
    found = transformed(make, NOISE, offset=[0.25, 0.25])

    assert found == pytest.approx(np.roll(NOISE, (3, -4), (0, 1)), abs=1e-6)


def test_half_a_texel_is_the_mean_of_two(make):
    found = transformed(make, NOISE, offset=[0.5 / 16, 0.0])

    assert found == pytest.approx((NOISE + np.roll(NOISE, -1, 1)) / 2, abs=1e-6)


def test_quarters_of_a_circle_turn_coordinates_counter_clockwise(make):
    # What stands at u = 1, v = 0 is looked for at the angle of v: the picture turns clockwise
    found = transformed(make, SQUARE, rotation=np.pi / 2)

    assert found == pytest.approx(np.rot90(SQUARE, -1), abs=1e-6)


@pytest.mark.parametrize("scale", [[-1.0, 1.0], [1.0, -1.0]])
def test_negative_scales_mirror(make, scale):
    expected = NOISE[:, ::-1] if scale[0] < 0 else NOISE[::-1]

    assert transformed(make, NOISE, scale=scale) == pytest.approx(expected, abs=1e-6)


def test_whole_repeats_tile_the_box_means_of_what_shrinks(make):
    found = transformed(make, NOISE, scale=[2.0, 3.0])

    means = NOISE.reshape(4, 3, 8, 2, 3).mean(axis=(1, 3))
    assert found == pytest.approx(np.tile(means, (3, 2, 1)), abs=1e-6)


def test_pixels_do_not_depend_on_the_number_of_threads(make, with_threads):
    one = with_threads(1, lambda: transformed(make, NOISE, rotation=0.3, scale=[1.5, 2.5]))
    two = with_threads(2, lambda: transformed(make, NOISE, rotation=0.3, scale=[1.5, 2.5]))

    assert one.tobytes() == two.tobytes()
