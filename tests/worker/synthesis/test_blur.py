"""A Gaussian against what it leaves of waves, and against its own moments."""

import numpy as np
import pytest

from worker.images.image import Image

ASSET = {"technique": "image", "asset": "0" * 64}


def blurred(make, pixels, **fields):
    body = {"technique": "blur", "input": ASSET, **fields}
    size = pixels.shape[1], pixels.shape[0]
    return make(body, size, lambda spec, meaning: Image(pixels, meaning))


def wave(cycles_u, cycles_v):
    u = (np.arange(48) + 0.5) / 48
    v = 1 - (np.arange(32) + 0.5) / 32
    phases = 2 * np.pi * (cycles_u * u + cycles_v * v[:, np.newaxis])
    return np.cos(phases)[..., np.newaxis]


@pytest.mark.parametrize("cycles", [(0, 0), (1, 0), (3, -2), (5, 7)])
def test_a_wave_fades_as_the_transform_of_a_gaussian_says(make, cycles):
    radius = [0.03, 0.05]

    found = blurred(make, np.float32(0.5 + 0.5 * wave(*cycles)), radius=radius)

    exponent = (cycles[0] * radius[0]) ** 2 + (cycles[1] * radius[1]) ** 2
    left = np.exp(-2 * np.pi**2 * exponent)
    assert found == pytest.approx(0.5 + 0.5 * left * wave(*cycles), abs=2e-7)


def test_a_point_becomes_a_bell_of_its_mass_and_its_spread(make):
    point = np.zeros((64, 64, 1), np.float32)
    point[32, 32] = 1

    bell = blurred(make, point, radius=[0.06, 0.04])[..., 0].astype(np.float64)

    from_middle = np.arange(64) - 32
    assert bell.sum() == pytest.approx(1, abs=1e-5)
    assert (bell.sum(0) * from_middle**2).sum() == pytest.approx((0.06 * 64) ** 2, rel=1e-3)
    assert (bell.sum(1) * from_middle**2).sum() == pytest.approx((0.04 * 64) ** 2, rel=1e-3)


def test_nothing_leaves_its_range_and_no_radius_changes_nothing(make):
    steps = np.float32(np.random.default_rng(1).random((24, 40, 3)) > 0.5)

    soft = blurred(make, steps, radius=[0.02, 0.02])

    assert 0 <= soft.min() < soft.max() <= 1
    assert blurred(make, steps, radius=[0.0, 0.0]).tobytes() == steps.tobytes()


def test_infinite_texels_do_not_spread_nothingness(make):
    pixels = np.ones((8, 8, 1), np.float32)
    pixels[3, 3], pixels[5, 5] = np.inf, np.nan

    assert np.isfinite(blurred(make, pixels, radius=[0.1, 0.1])).all()
