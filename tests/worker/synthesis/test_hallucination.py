"""Detail from an exemplar: T64."""

import numpy as np
import pytest
from scipy import ndimage

from tests.growing import grow, noise
from worker.synthesis._resample import resample


def detailed(side, seed):
    """Fine and coarse grain together."""
    fine = ndimage.gaussian_filter(noise(side, side, 1, seed), (0.7, 0.7, 0), mode="wrap")
    coarse = ndimage.gaussian_filter(noise(side, side, 1, seed + 9), (5, 5, 0), mode="wrap")
    return (0.3 + 0.5 * (fine - 0.5) + 2.5 * (coarse - 0.5)).clip(0, 1).astype(np.float32)


def enlarge(small, exemplar, factor):
    size = (small.shape[1] * factor, small.shape[0] * factor)
    return grow("hallucination", exemplar, size, target=small, factor=factor)


@pytest.mark.parametrize("factor", [2, 4])
def test_made_small_again_it_is_what_it_was_and_it_has_detail(factor):
    exemplar = detailed(96, 1)
    small = resample(detailed(96, 2), (96 // factor, 96 // factor))

    made = enlarge(small, exemplar, factor)

    assert made.report["residual"] < 1 / 255
    again = resample(made.image.pixels, small.shape[1::-1])
    assert again == pytest.approx(small, abs=1 / 255)
    assert fine_energy(made.image.pixels, factor) > 4 * fine_energy(
        resample(small, (96, 96)), factor
    )


def fine_energy(pixels, factor):
    """Energy of waves that the small picture cannot hold."""
    power = np.abs(np.fft.fft2(pixels[..., 0])) ** 2
    frequencies = np.abs(np.fft.fftfreq(96))
    return power[np.maximum.outer(frequencies, frequencies) > 0.5 / factor].sum()


def test_a_picture_with_another_number_of_channels():
    made = enlarge(noise(9, 7), noise(20, 20, 1), 2)

    assert made.image.pixels.shape == (18, 14, 3)
    assert np.isfinite(made.image.pixels).all()
