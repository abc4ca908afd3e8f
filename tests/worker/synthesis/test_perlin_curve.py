"""Noise along a line against the values of T45 (A8), its own slopes, and its picture."""

import numpy as np
import pytest

from api_schemas.textures.perlin_curve import PerlinCurveSpec
from worker.stages import silent
from worker.synthesis.perlin_curve import gradients_of, noise_at, synthesize

FIVE = [1.0, -1.0, 0.0, 1.0, 0.0]


def spec(**fields):
    return PerlinCurveSpec(technique="perlin_curve", **fields)


def made(size, **fields):
    return synthesize(spec(**fields), size, {}, silent)


@pytest.mark.parametrize(
    ("fade", "places", "values"),
    [
        ("quintic", [0.5, 1.25, 4.5], [0.5, -0.22412109375, -0.25]),
        ("cubic", [1.25], [-0.2109375]),
    ],
)
def test_a8_the_job_tells_the_values_of_five_slopes(fade, places, values):
    told = made((4, 4), gradients=FIVE, fade=fade, at=places).report

    assert told["values"] == pytest.approx(values, abs=1e-12)


def test_it_is_zero_at_whole_numbers_with_the_slope_given_there():
    values, slopes = noise_at(spec(gradients=FIVE), np.arange(-10.0, 10.0))

    assert (values == 0).all()
    assert slopes.tolist() == FIVE * 4


@pytest.mark.parametrize("fade", ["quintic", "cubic", "linear"])
def test_slopes_are_the_limits_of_differences(fade):
    x, step = np.linspace(-3, 9, 97) + 0.01, 2.0**-16
    curve = spec(frequency=7, seed=4, fade=fade)

    _, slopes = noise_at(curve, x)

    rises = noise_at(curve, x + step)[0] - noise_at(curve, x - step)[0]
    # Third derivatives stay below 400
    assert slopes == pytest.approx(rises / (2 * step), abs=100 * step**2 + 1e-10)


def test_drawn_slopes_are_the_three_named():
    drawn = gradients_of(spec(frequency=256, seed=1))

    assert set(drawn) == {-1, 0, 1}
    # 256 of three: four standard errors are 31
    assert abs(np.count_nonzero(drawn == 0) - 256 / 3) < 31


def test_it_repeats_after_its_slopes():
    curve = spec(gradients=FIVE)
    x = np.arange(64) / 16.0

    assert (noise_at(curve, x)[0] == noise_at(curve, x - 15)[0]).all()


def test_the_picture_is_dark_where_the_curve_is():
    pixels = made((200, 100), gradients=FIVE).image.pixels[..., 0]

    # At x = .5, in the column at 1/10 of a period, the curve is at .5: a quarter from the top
    assert pixels[24:26, 20].max() < 0.6
    assert (pixels[[5, 50, 90], 20] == 1).all()
    thin = made((2000, 1000), gradients=FIVE).image.pixels
    # A line 1 % thick over a length of at least a picture
    assert 0.01 <= 1 - thin.mean() <= 0.02


def test_values_are_stripes_of_the_curve():
    pixels = made((50, 3), gradients=FIVE, show="values").image.pixels

    x = (np.arange(50) + 0.5) / 10
    assert pixels[..., 0] == pytest.approx(
        np.tile((noise_at(spec(gradients=FIVE), x)[0] + 1) / 2, (3, 1)), abs=1e-7
    )
