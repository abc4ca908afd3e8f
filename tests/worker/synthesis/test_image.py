"""Pictures brought to another size, against means and blends worked out by hand."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from worker.images.image import Image
from worker.stages import silent
from worker.synthesis.image import synthesize


def resized(pixels, size):
    pixels = np.array(pixels, np.float32)
    before = pixels.copy()
    pixels.flags.writeable = False
    image = synthesize(None, size, {"asset": Image(pixels, "data")}, silent)
    assert pixels.tobytes() == before.tobytes()
    assert image.meaning == "data"
    return image.pixels


def random_pixels(width, height, channels=3):
    return np.random.default_rng(width * 1000 + height).random((height, width, channels), "f4")


def test_at_its_own_size_a_picture_keeps_every_bit():
    pixels = random_pixels(7, 5)
    pixels[0, 0] = [np.inf, -0.0, 1e-42]

    assert resized(pixels, (7, 5)).tobytes() == pixels.tobytes()


def test_an_axis_that_keeps_its_length_is_left_alone():
    pixels = random_pixels(6, 4)

    halved = resized(pixels, (3, 4))

    expected = pixels.astype(np.float64).reshape(4, 3, 2, 3).mean(axis=2)
    assert (halved == expected.astype(np.float32)).all()


def test_shrinking_takes_the_mean_over_the_area_of_a_pixel():
    row = np.float32([1, 10, 100, 1000, 10000]).reshape(1, 5, 1)

    # Each of two pixels covers two and a half texels, each of three one and two thirds
    halves = resized(row, (2, 1)).ravel()
    thirds = resized(row, (3, 1)).ravel()

    assert halves == pytest.approx([(11 + 50) / 2.5, (50 + 11000) / 2.5], rel=1e-7)
    assert thirds == pytest.approx(
        [
            (1 + 10 * 2 / 3) * 0.6,
            (10 / 3 + 100 + 1000 / 3) * 0.6,
            (1000 * 2 / 3 + 10000) * 0.6,
        ],
        rel=1e-7,
    )


@given(*[st.integers(1, 40)] * 4)
def test_shrinking_keeps_the_mean(width, height, new_width, new_height):
    pixels = random_pixels(width, height)
    size = (min(width, new_width), min(height, new_height))

    mean = resized(pixels, size).mean(axis=(0, 1), dtype=np.float64)

    assert mean == pytest.approx(pixels.mean(axis=(0, 1), dtype=np.float64), abs=1e-7)


def test_enlarging_blends_between_texel_centres_and_around_the_edges():
    # New centres lie at -1/4, 1/4, 3/4, 5/4 of a texel from the first one
    row = np.float32([0, 8]).reshape(1, 2, 1)

    assert resized(row, (4, 1)).ravel().tolist() == [2, 2, 6, 6]
    assert resized(row.reshape(2, 1, 1), (1, 4)).ravel().tolist() == [2, 2, 6, 6]
    assert resized(np.float32([0, 9, 9]).reshape(1, 3, 1), (6, 1)).ravel().tolist() == [
        2.25, 2.25, 6.75, 9, 9, 6.75,
    ]  # fmt: skip


def test_enlarging_keeps_the_known_bilinear_values():
    # T42: 2x2 [[0, 1], [2, 4]] with v upwards at (.5, .5) is 1.75, at (.25, .25) is 0
    texels = np.float32([[2, 4], [0, 1]])[..., np.newaxis]

    large = resized(texels, (6, 6))[..., 0]

    assert large[4, 1] == 0  # its centre is (.25, .25)
    assert large[2:4, 2:4].mean() == pytest.approx(1.75, abs=1e-6)


@given(*[st.integers(1, 30)] * 4)
def test_a_constant_stays_the_constant(width, height, new_width, new_height):
    pixels = np.full((height, width, 2), [0.3, 1e4], np.float32)

    large = resized(pixels, (new_width, new_height))

    # Weights are rounded in float64, their sum to float32
    assert large == pytest.approx(np.broadcast_to(pixels[0, 0], large.shape), rel=1.2e-7)


def test_an_infinite_texel_does_not_spread_to_pixels_that_miss_it():
    row = np.float32([np.inf, 1, 2, 3]).reshape(1, 4, 1)

    assert resized(row, (2, 1)).ravel().tolist() == [np.inf, 2.5]


def test_pixels_do_not_depend_on_the_number_of_threads(with_threads):
    pixels = random_pixels(150, 90)

    one = with_threads(1, lambda: resized(pixels, (91, 133)))
    two = with_threads(2, lambda: resized(pixels, (91, 133)))

    assert one.tobytes() == two.tobytes()
