"""Histogram-preserving blends: X09."""

import numpy as np
import pytest
from scipy import ndimage, stats

from tests.growing import grow as grow_by
from tests.growing import noise
from worker.synthesis.by_example_noise import blend, from_gaussian, to_gaussian


def grow(exemplar, size, **fields):
    return grow_by("by_example_noise", exemplar, size, **fields).image.pixels


def test_the_blend_of_the_reference():
    weights = np.array([[0.5], [0.3], [0.2]])
    values = np.array([[[0.8]], [[0.4]], [[0.6]]]) - 0.5

    assert blend(values, weights)[0, 0] + 0.5 == pytest.approx(0.727109990, abs=1e-9)


def test_there_and_back_is_the_same():
    pixels = noise(30, 20).astype(np.float64)
    gaussian = to_gaussian(pixels)

    assert gaussian.values.mean(axis=(0, 1)) == pytest.approx(0, abs=1e-9)
    assert gaussian.values.var(axis=(0, 1)) == pytest.approx(1, abs=0.02)
    back = from_gaussian(gaussian.values.reshape(-1, 3), gaussian)
    assert back.reshape(30, 20, 3) == pytest.approx(pixels, abs=1e-9)


def test_variance_and_histogram_stay():
    exemplar = ndimage.gaussian_filter(noise(256, 256, 1), (1, 1, 0)) ** 3

    pixels = grow(exemplar, (256, 256), piece=8)

    assert pixels.var() == pytest.approx(exemplar.var(), rel=0.05)
    assert stats.ks_2samp(pixels.ravel(), exemplar.ravel()).statistic < 0.02


def test_it_goes_on_around_its_edges():
    exemplar = ndimage.gaussian_filter(noise(96, 96, 1), (4, 4, 0))

    pixels = grow(exemplar, (90, 70), piece=20)[..., 0]

    steps = np.abs(np.diff(np.pad(pixels, ((0, 1), (0, 1)), mode="wrap"), axis=0)).mean(axis=1)
    assert steps[-1] <= steps[:-1].max() * 1.2


@pytest.mark.parametrize("shape", [(1, 1), (2, 5), (40, 30)])
@pytest.mark.parametrize("size", [(1, 1), (20, 33)])
def test_any_size_stays_within_the_exemplars_range(shape, size):
    exemplar = noise(*shape) * 7

    pixels = grow(exemplar, size)

    assert pixels.shape == (size[1], size[0], 3)
    assert (pixels >= exemplar.min(axis=(0, 1))).all()
    assert (pixels <= exemplar.max(axis=(0, 1))).all()


def test_what_has_no_alpha_is_never_blended():
    exemplar = np.concatenate([noise(40, 40), np.ones((40, 40, 1), np.float32)], axis=-1)
    exemplar[0:4, :] = 0

    # Ranks of alpha: what may be copied is all above what may not
    assert (grow(exemplar, (30, 30), piece=8)[..., 3] > 0.5).all()
