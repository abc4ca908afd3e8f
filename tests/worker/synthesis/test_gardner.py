"""Sums of cosines against T44's values, closed forms and their own spectrum."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from api_schemas.textures.gardner import GardnerSpec
from worker.stages import silent
from worker.synthesis.gardner import (
    _angles,
    mean_at,
    sum_of_cosines,
    synthesize,
    synthesize_volume,
    waves_of,
)

# Float32 rounds both factors, products and sums of n terms of at most 1/n
GEMM_ERROR = 1e-6


def spec(**fields):
    return GardnerSpec(technique="gardner", **fields)


def picture(size, **fields):
    return synthesize(spec(**fields), size, {}, silent).pixels[..., 0]


def test_a25_the_sum_has_the_values_of_the_six_waves_of_t44():
    waves = np.array(
        [
            (3, 1, 0.2),
            (-2, 2.5, 1.1),
            (0.5, -3.2, 2.7),
            (2.2, 2.4, 0.9),
            (-3.1, 0.3, 4),
            (1.4, -2.9, 5.5),
        ]
    )

    values = sum_of_cosines(np.array([0, 0.5]), np.array([0, -1.25]), waves[:, :2], waves[:, 2])

    assert values == pytest.approx([1.206226678948, -0.170750515], abs=1e-9)


@given(
    st.tuples(st.integers(1, 40), st.integers(1, 40)),
    st.lists(
        st.fixed_dictionaries(
            {
                "cycles": st.lists(st.integers(-30, 30), min_size=2, max_size=2),
                "phase": st.floats(-10, 10),
            }
        ),
        min_size=1,
        max_size=5,
    ),
)
def test_a_pixel_is_the_mean_over_its_area(size, waves):
    width, height = size

    def mean(swings, phase, low, high):
        if swings == 0:
            return np.exp(1j * phase) * np.ones_like(low)
        angle = 2j * np.pi * swings
        part = np.exp(angle * high) - np.exp(angle * low)
        return np.exp(1j * phase) * part / (angle * (high - low))

    left, bottom = np.arange(width) / width, 1 - (np.arange(height) + 1) / height
    expected = np.zeros((height, width))
    for wave in waves:
        across = mean(wave["cycles"][0], 0.0, left, left + 1 / width)
        down = mean(wave["cycles"][1], wave["phase"], bottom, bottom + 1 / height)
        expected += np.multiply.outer(down, across).real / len(waves)

    signed = picture(size, waves=waves, range="signed")

    assert signed == pytest.approx(expected, abs=GEMM_ERROR)
    assert picture(size, waves=waves) == pytest.approx((signed + 1) / 2, abs=GEMM_ERROR)


def test_a_fine_picture_is_the_sum_at_its_pixel_centres():
    fields = {"frequency": 2, "bandwidth": 3, "count": 9, "seed": 3}
    cycles, phases = waves_of(spec(**fields), 2)
    u, v = np.meshgrid((np.arange(1024) + 0.5) / 1024, 1 - (np.arange(512) + 0.5) / 512)

    pixels = picture((1024, 512), **fields, range="signed")

    expected = sum_of_cosines(u, v, 2 * np.pi * cycles, phases) / 9
    # What a sinc of 5 swings in 512 pixels takes away, (pi 5 / 512)^2 / 6
    assert pixels == pytest.approx(expected, abs=2 * 1.6e-4)


def test_all_energy_lies_in_the_bins_of_the_annulus():
    pixels = picture((256, 256), frequency=10, bandwidth=6, count=40, seed=1, range="signed")

    energy = abs(np.fft.fft2(pixels.astype(np.float64))) ** 2
    waves = np.fft.fftfreq(256, 1 / 256)
    radius = np.hypot(waves[:, np.newaxis], waves)
    band = energy[(radius >= 10) & (radius <= 16)].sum() / energy.sum()
    # The rest is float32 rounding, 2^-24 squared against a variance of 1/80
    assert 1 - band < 1e-11
    assert np.count_nonzero(energy > 1e-6 * energy.max()) == 2 * 40


def test_n_waves_have_the_variance_of_a_cosine_over_n():
    pixels = picture((512, 512), frequency=4, bandwidth=2, count=8, range="signed")

    # sinc^2 of at most 6 swings in 512 pixels, twice: 1 - (pi 6 / 512)^2 / 3 and 2^-24
    assert pixels.var(dtype=np.float64) == pytest.approx(0.5 / 8, rel=1e-3)
    assert pixels.mean(dtype=np.float64) == pytest.approx(0, abs=1e-7)


def test_no_wave_comes_twice_until_all_have_come():
    cycles, _ = waves_of(spec(frequency=1, bandwidth=1, count=8, seed=9), 2)

    # All whole points with 1 <= a^2 + b^2 <= 4, one of each opposite pair: six
    pairs = [tuple(pair) for pair in cycles[:, :2].tolist()]
    assert len(set(pairs)) == 6
    assert all(1 <= a * a + b * b <= 4 for a, b in pairs)
    assert not {(-a, -b) for a, b in pairs} & set(pairs)


@pytest.mark.parametrize("pixels", [1, 7, 96, 2100])
def test_angles_repeat_bit_for_bit(pixels):
    cycles = np.array([0, 1, -3, 1024])

    angles, _ = _angles(cycles, np.arange(3 * pixels), pixels)

    assert angles[:, :pixels].tobytes() == angles[:, pixels : 2 * pixels].tobytes()
    assert angles[:, :pixels].tobytes() == angles[:, 2 * pixels :].tobytes()


def test_waves_finer_than_the_pixels_leave_their_mean():
    wave = {"cycles": [64, 0], "phase": 0.0}

    assert picture((64, 8), waves=[wave]) == pytest.approx(0.5, abs=GEMM_ERROR)


def solid(size, **fields):
    return synthesize_volume(spec(**fields), size, {}, silent).voxels[..., 0]


def test_all_energy_of_a_solid_lies_in_the_bins_of_the_shell():
    cube = solid((48, 48, 48), frequency=4, bandwidth=2, count=20, seed=2, range="signed")

    energy = abs(np.fft.fftn(cube.astype(np.float64))) ** 2
    waves = np.fft.fftfreq(48, 1 / 48)
    radius = np.sqrt(sum(axis**2 for axis in np.meshgrid(waves, waves, waves)))
    # The rest is float32 rounding, 2^-24 squared against a variance of 1/40
    assert 1 - energy[(radius >= 4) & (radius <= 6)].sum() / energy.sum() < 1e-11
    assert np.count_nonzero(energy > 1e-6 * energy.max()) == 2 * 20


@pytest.mark.parametrize(("size", "made"), [((9, 7), picture), ((9, 7, 5), solid)])
def test_points_are_what_grids_show(size, made):
    waves = [{"cycles": [2, -1, 3], "phase": 0.4}, {"cycles": [-5, 2], "phase": 2.0}]
    centres = [(np.arange(count) + 0.5) / count for count in size]
    centres[1] = centres[1][::-1]
    places = np.stack(np.meshgrid(*centres[::-1], indexing="ij")[::-1], axis=-1)

    found = mean_at(spec(waves=waves), places.reshape(-1, len(size)), np.diag(1 / np.array(size)))

    assert made(size, waves=waves).ravel() == pytest.approx(found, abs=GEMM_ERROR)


def test_no_wave_of_space_comes_twice():
    cycles, _ = waves_of(spec(frequency=1, bandwidth=0, count=4, seed=9), 3)

    # Of the six whole points at distance 1 one of each opposite pair
    assert len({tuple(cycle) for cycle in cycles.tolist()}) == 3
    assert (abs(cycles).sum(axis=1) == 1).all()
