"""X13: even at every threshold, with next to nothing below half the principal frequency."""

import numpy as np
import pytest

from worker.synthesis.blue_noise import ranks


def power(picture):
    """Return the power by frequency in cycles per pixel, 1 where white noise would be."""
    spectrum = np.abs(np.fft.fft2(picture - picture.mean())) ** 2 / picture.size / picture.var()
    frequencies = np.fft.fftfreq(len(picture))
    return np.hypot(*np.meshgrid(frequencies, frequencies)), spectrum


def test_every_value_is_there_once(make):
    tile = make({"technique": "blue_noise", "side": 32, "seed": 7}, (32, 32))[..., 0]

    assert np.sort(tile, axis=None) == pytest.approx((np.arange(1024) + 0.5) / 1024, abs=1e-7)


@pytest.mark.parametrize("share", [0.1, 0.25, 0.5, 0.8])
def test_x13_below_half_the_principal_frequency_there_is_a_tenth_of_white(share):
    dots = (ranks(64, 3) < share * 64 * 64).astype(float)

    radius, spectrum = power(dots)

    # n points scattered evenly are 1 / sqrt(n) apart, if a grid of pixels can show it
    principal = min(np.sqrt(min(share, 1 - share)), 0.5)
    low = (radius > 0) & (radius < principal / 2)
    assert dots.mean() == pytest.approx(share, abs=1 / 4096)
    assert spectrum[low].mean() < 0.1
    assert spectrum[radius > principal].mean() > 0.8


def test_the_noise_itself_has_a_tenth_of_white_below_a_quarter():
    radius, spectrum = power(ranks(64, 0).astype(float))

    assert spectrum[(radius > 0) & (radius < 0.25)].mean() < 0.1


def test_the_tile_has_no_seam():
    """Points a tenth as many as pixels keep their distance across the edges too."""
    tile = ranks(32, 5) < 102
    places = np.argwhere(tile)
    apart = np.abs(places[:, np.newaxis] - places)
    apart = np.minimum(apart, 32 - apart)
    nearest = np.sqrt((apart**2).sum(-1) + 1e9 * np.eye(len(places))).min(axis=1)

    # Evenly scattered, 3.13 pixels; points by chance come as near as half of it on average
    assert nearest.min() >= 2
    assert nearest.mean() > 2.6


def test_it_repeats_pixel_by_pixel_and_another_seed_is_another_noise(make):
    body = {"technique": "blue_noise", "side": 16, "seed": 1}

    picture = make(body, (40, 24))[..., 0]

    assert (picture[:16, :16] == picture[:16, 16:32]).all()
    assert (picture[16:, 32:] == picture[:8, :8]).all()
    assert (picture != make({**body, "seed": 2}, (40, 24))[..., 0]).mean() > 0.9
