"""Gabor noise against the integral of its kernel (X12), its variance, spectrum and plain sums."""

import numpy as np
import pytest

from api_schemas.textures.gabor import GaborSpec
from worker.stages import silent
from worker.synthesis._gabor_rows import CUT
from worker.synthesis._gabor_solid import solid_energy, solid_impulses
from worker.synthesis.gabor import energy, impulses_of, synthesize, synthesize_volume, variance


def spec(**fields):
    return GaborSpec(technique="gabor", **fields)


def noise(size, **fields):
    """The noise with variance 1."""
    return 4 * synthesize(spec(range="signed", **fields), size, {}, silent).pixels[..., 0]


def kernel(x, y, frequency, bandwidth, direction=0.0):
    wave = np.cos(2 * np.pi * frequency * (x * np.cos(direction) + y * np.sin(direction)))
    return np.exp(-np.pi * bandwidth**2 * (x * x + y * y)) * wave


def test_x12_the_energy_of_a_kernel_is_the_integral_of_its_square():
    assert energy(0.0625, 0.05) == pytest.approx(100.005449, abs=1e-6)
    x = np.arange(-60, 60, 0.25)
    square = kernel(x, x[:, np.newaxis], 0.0625, 0.05) ** 2
    assert square.sum() / 16 == pytest.approx(100.005449, abs=1e-5)


def test_a_pixel_is_the_sum_of_all_kernels_and_of_their_copies():
    fields = {"frequency": 3.5, "bandwidth": 2.0, "orientation": 0.4, "spread": 1.0, "seed": 3}
    gabor = spec(**fields, impulses=5)
    found = impulses_of(gabor)
    u, v = np.meshgrid((np.arange(48) + 0.5) / 48, 1 - (np.arange(40) + 0.5) / 40)
    expected = np.zeros(u.shape)
    for n in range(len(found.u)):
        for i in range(-2, 3):
            for j in range(-2, 3):
                x, y = u - found.u[n] + i, v - found.v[n] + j
                near = (abs(x) <= CUT / 2) & (abs(y) <= CUT / 2)
                value = kernel(x, y, 3.5, 2.0, found.directions[n])
                expected += near * found.weights[n] * value

    pixels = noise((48, 40), **fields, impulses=5)

    assert pixels == pytest.approx(expected / np.sqrt(variance(gabor, len(found.u))), abs=2e-6)


@pytest.mark.parametrize("spread", [0.0, 3.14159])
def test_x12_the_variance_is_density_times_energy(spread):
    fields = {"frequency": 40.0, "bandwidth": 16.0, "spread": spread}

    found = np.mean([noise((256, 256), **fields, seed=seed).var() for seed in range(8)])

    # 8 x 16^2 independent places, of which each deviates by sqrt 2: four standard errors 12 %
    assert found == pytest.approx(1, rel=0.12)


def test_waves_run_where_they_are_told_to():
    pixels = noise((256, 256), frequency=32.0, bandwidth=4.0, orientation=np.pi / 2)

    energy = abs(np.fft.fft2(pixels)) ** 2
    waves = np.fft.fftfreq(256, 1 / 256)
    # Up and down only; a Gaussian of bandwidth 4 has 99.9 % within 4 of its middle
    band = (abs(waves[:, np.newaxis]) > 26) & (abs(waves[:, np.newaxis]) < 38)
    band = band & (abs(waves) < 6)
    assert energy[band].sum() / energy.sum() > 0.99


def test_turned_all_ways_it_is_a_ring_of_frequencies():
    pixels = noise((256, 256), frequency=32.0, bandwidth=4.0, spread=np.pi)

    energy = abs(np.fft.fft2(pixels)) ** 2
    waves = np.fft.fftfreq(256, 1 / 256)
    radius = np.hypot(waves, waves[:, np.newaxis])
    assert energy[(radius > 26) & (radius < 38)].sum() / energy.sum() > 0.99
    quadrant = energy[1:128, 1:128].sum() / energy[1:128, 129:].sum()
    # About 2 x 32 x pi / 4 / 4 packets' bins on each side
    assert 0.4 < quadrant < 2.5


def test_opposite_edges_join():
    pixels = noise((200, 150), frequency=9.7, bandwidth=3.0, spread=0.5)

    for axis in (0, 1):
        seam = abs(np.take(pixels, 0, axis) - np.take(pixels, -1, axis)).max()
        assert seam <= abs(np.diff(pixels, axis=axis)).max() * 1.2


def test_waves_finer_than_the_pixels_fade():
    assert (noise((64, 64), frequency=31.0, bandwidth=1.0) == 0).all()


def test_pixels_do_not_depend_on_the_number_of_threads(with_threads):
    one = with_threads(1, lambda: noise((100, 90), frequency=8.0))
    two = with_threads(2, lambda: noise((100, 90), frequency=8.0))

    assert one.tobytes() == two.tobytes()


def solid(size, **fields):
    """The noise in space with variance 1."""
    made = synthesize_volume(spec(range="signed", **fields), size, {}, silent)
    return 4 * made.voxels[..., 0].astype(np.float64)


def test_x12_the_energy_of_a_kernel_of_space_is_the_integral_of_its_square():
    x = np.arange(-40, 40) / 8
    square = np.add.outer(np.add.outer(x * x, x * x), x * x)
    wave = np.exp(-np.pi * 0.5**2 * square) * np.cos(2 * np.pi * 0.4 * x)

    assert solid_energy(0.4, 0.5) == pytest.approx((wave**2).sum() / 512, rel=1e-6)


def test_a_voxel_is_the_sum_of_all_kernels_and_of_their_copies():
    fields = {"frequency": 1.75, "bandwidth": 1.5, "orientation": 0.4, "spread": 1.0, "seed": 3}
    found = solid_impulses(spec(**fields, impulses=9))
    w, v, u = np.meshgrid(*[(np.arange(n) + 0.5) / n for n in (13, 14, 15)], indexing="ij")
    here = np.stack([u, 1 - v, w], axis=-1)
    expected = np.zeros(u.shape)
    for place, direction, weight in zip(*found, strict=True):
        for turn in np.ndindex(3, 3, 3):
            off = here - place + turn - 1
            near = (np.abs(off) <= CUT / 1.5).all(axis=-1)
            under = np.exp(-np.pi * 2.25 * (off**2).sum(axis=-1))
            expected += near * weight * under * np.cos(2 * np.pi * 1.75 * (off @ direction))
    variance = len(found.weights) * solid_energy(1.75, 1.5)

    voxels = solid((15, 14, 13), **fields, impulses=9)

    assert voxels == pytest.approx(expected / np.sqrt(variance), abs=2e-6)


@pytest.mark.parametrize("spread", [0.0, 0.7, np.pi])
def test_waves_of_space_run_as_far_from_where_they_are_told_as_they_may(spread):
    directions = solid_impulses(spec(spread=spread, orientation=0.5, bandwidth=16)).directions

    assert np.linalg.norm(directions, axis=1) == pytest.approx(1)
    cosines = directions @ [np.cos(0.5), np.sin(0.5), 0]
    # Even over the cap: heights on a sphere are
    assert cosines.min() >= np.cos(spread) - 1e-12
    assert cosines.mean() == pytest.approx((1 + np.cos(spread)) / 2, abs=0.02)


def test_x12_the_variance_in_space_is_density_times_energy():
    fields = {"frequency": 10.0, "bandwidth": 6.0, "spread": np.pi, "impulses": 8}

    found = np.mean([solid((64, 64, 64), **fields, seed=seed).var() for seed in range(3)])

    # 3 x 6^3 independent places, of which each deviates by sqrt 2: four standard errors 22 %
    assert found == pytest.approx(1, rel=0.22)


def test_a_solid_of_waves_joins_its_opposite_faces():
    cube = solid((32, 32, 32), frequency=3.0, bandwidth=2.0, spread=2.0, impulses=4)

    for axis in range(3):
        seam = np.abs(np.take(cube, 0, axis) - np.take(cube, -1, axis)).max()
        assert seam <= 1.2 * np.abs(np.diff(cube, axis=axis)).max()


def test_voxels_do_not_depend_on_the_number_of_threads(with_threads):
    fields = {"frequency": 3.0, "bandwidth": 2.0, "impulses": 2}

    one = with_threads(1, lambda: solid((16, 15, 14), **fields).tobytes())
    two = with_threads(2, lambda: solid((16, 15, 14), **fields).tobytes())

    assert one == two
