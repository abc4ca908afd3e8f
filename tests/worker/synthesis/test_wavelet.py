"""Wavelet noise against the facts about its published filters (T63, A22) and its spectrum."""

import numpy as np
import pytest

from api_schemas.textures.wavelet import WaveletSpec
from worker.stages import silent
from worker.synthesis._wavelet_bands import DOWN, UP, band, downsample, upsample, white_noise
from worker.synthesis.wavelet import spline_blends, synthesize


def noise(size, **fields):
    """The noise with variance 1."""
    spec = WaveletSpec(technique="wavelet", range="signed", **fields)
    return 4 * synthesize(spec, size, {}, silent).pixels[..., 0].astype(np.float64)


def test_the_taps_sum_to_one_as_printed():
    assert DOWN.astype(np.float64).sum() == pytest.approx(0.999999, abs=1e-7)
    assert UP.sum() == 2


def test_downsampling_undoes_upsampling_up_to_the_rounding_of_the_taps():
    impulses = np.eye(64, dtype=np.float32)

    error = abs(downsample(upsample(impulses)) - impulses).max()

    assert error == pytest.approx(1.315e-4, abs=1e-6)


def test_nothing_of_a_band_is_left_on_the_coarser_grid():
    fine = white_noise(3, 0, 128)
    detail = fine - upsample(downsample(fine))

    assert abs(downsample(detail)).max() < 3e-3


def test_white_noise_is_white():
    numbers = white_noise(5, 1, 512).astype(np.float64)

    # 262144 numbers: four standard errors of mean and correlation .0078, of the variance .0103
    assert numbers.mean() == pytest.approx(0, abs=0.0078)
    assert numbers.var() == pytest.approx(1, abs=0.0103)
    assert (numbers * np.roll(numbers, 1, axis=1)).mean() == pytest.approx(0, abs=0.0078)
    assert (numbers * white_noise(5, 2, 512)).mean() == pytest.approx(0, abs=0.0078)


@pytest.mark.parametrize(
    ("normalization", "variance"), [("exact", 1.0), ("paper", 0.269936 / 0.265)]
)
def test_the_variance_is_that_of_the_filters(normalization, variance):
    fields = {"frequency": 64, "normalization": normalization}

    found = np.mean([noise((512, 512), **fields, seed=seed).var() for seed in range(8)])

    # 8 x 16384 coefficients, of which a band holds about half: four standard errors are 2.2 %
    assert found == pytest.approx(variance, rel=0.022)


def test_bands_are_divided_by_the_root_of_the_sum_of_their_squares():
    pixels = noise((1024, 1024), frequency=64, bands=3, gain=0.7)

    assert pixels.var() == pytest.approx(1, rel=0.05)


@pytest.mark.parametrize("seed", [0, 1, 2])
def test_its_energy_keeps_to_its_octave(seed):
    pixels = noise((1024, 1024), frequency=32, seed=seed)

    energy = abs(np.fft.fft2(pixels)) ** 2
    waves = np.fft.fftfreq(1024, 1 / 1024) / 64
    radius = np.hypot(waves[:, np.newaxis], waves)
    assert energy[(radius >= 0.26) & (radius < 0.52)].sum() / energy.sum() == pytest.approx(
        0.847, abs=0.02
    )
    assert energy[radius < 0.13].sum() / energy.sum() < 1e-4
    assert abs(pixels.mean()) < 1e-4


def test_a_pixel_is_the_spline_of_the_published_code():
    side, width, height = 12, 50, 31
    coefficients = band(9, 0, side).astype(np.float64)

    def weights(x):
        middle = int(np.ceil(x - 0.5))
        t = middle - (x - 0.5)
        return middle, [t * t / 2, 1 - t * t / 2 - (1 - t) ** 2 / 2, (1 - t) ** 2 / 2]

    expected = np.zeros((height, width))
    for row in range(height):
        for column in range(width):
            across, w_across = weights((column + 0.5) / width * side)
            up, w_up = weights((height - row - 0.5) / height * side)
            for j in range(3):
                for i in range(3):
                    value = coefficients[(up - 1 + j) % side, (across - 1 + i) % side]
                    expected[row, column] += w_up[j] * w_across[i] * value

    found = noise((width, height), frequency=6, seed=9) * 0.269936**0.5

    assert found == pytest.approx(expected, abs=2e-6)


def test_splines_repeat_bit_for_bit():
    blends = spline_blends(np.arange(300), 100, 14)

    for part in blends:
        assert part[:100].tobytes() == part[100:200].tobytes() == part[200:].tobytes()


def test_opposite_edges_join():
    pixels = noise((256, 256), frequency=4)

    for axis in (0, 1):
        seam = abs(np.take(pixels, 0, axis) - np.take(pixels, -1, axis)).max()
        assert seam <= abs(np.diff(pixels, axis=axis)).max() * 1.2


def test_bands_finer_than_two_pixels_are_left_out():
    assert (noise((32, 32), frequency=16) == 0).all()
    assert (noise((64, 64), frequency=16) != 0).any()


def test_the_unit_range_is_half_a_unit_up():
    spec = WaveletSpec(technique="wavelet", frequency=8)

    unit = synthesize(spec, (64, 64), {}, silent).pixels[..., 0]

    assert unit == pytest.approx(0.5 + noise((64, 64), frequency=8) / 8, abs=1e-6)


def test_pixels_do_not_depend_on_the_number_of_threads(with_threads):
    one = with_threads(1, lambda: noise((200, 150), frequency=10, bands=2))
    two = with_threads(2, lambda: noise((200, 150), frequency=10, bands=2))

    assert one.tobytes() == two.tobytes()
