"""Wavelet noise against the facts about its published filters (T63, A22) and its spectrum."""

import numpy as np
import pytest

from api_schemas.textures.wavelet import WaveletSpec
from worker.stages import silent
from worker.synthesis._wavelet_bands import DOWN, UP, band, downsample, upsample, white_noise
from worker.synthesis._wavelet_points import fill_projected_at
from worker.synthesis.wavelet import noise_at, spline_blends, synthesize, synthesize_volume


def noise(size, **fields):
    """The noise with variance 1."""
    spec = WaveletSpec(technique="wavelet", range="signed", **fields)
    return 4 * synthesize(spec, size, {}, silent).pixels[..., 0].astype(np.float64)


def test_a22_the_taps_sum_to_one_as_printed():
    assert DOWN.astype(np.float64).sum() == pytest.approx(0.999999, abs=1e-7)
    assert UP.sum() == 2


def test_a22_downsampling_undoes_upsampling_up_to_the_rounding_of_the_taps():
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
def test_t63_its_energy_keeps_to_its_octave(seed):
    pixels = noise((1024, 1024), frequency=32, seed=seed)

    energy = abs(np.fft.fft2(pixels)) ** 2
    waves = np.fft.fftfreq(1024, 1 / 1024) / 64
    radius = np.hypot(waves[:, np.newaxis], waves)
    assert energy[(radius >= 0.26) & (radius < 0.52)].sum() / energy.sum() == pytest.approx(
        0.847, abs=0.02
    )
    assert energy[radius < 0.13].sum() / energy.sum() < 1e-4
    assert abs(pixels.mean()) < 1e-4


def solid(size, **fields):
    """The solid noise with variance 1."""
    spec = WaveletSpec(technique="wavelet", range="signed", **fields)
    return 4 * synthesize_volume(spec, size, {}, silent).voxels[..., 0].astype(np.float64)


@pytest.mark.parametrize(
    ("normalization", "variance"), [("exact", 1.0), ("paper", 0.195606 / 0.210)]
)
def test_a22_the_variance_in_space_is_that_of_the_filters(normalization, variance):
    fields = {"frequency": 32, "normalization": normalization}

    found = np.mean([solid((160, 160, 160), **fields, seed=seed).var() for seed in range(2)])

    # 2 x 262144 coefficients, a band holds about half: four standard errors are 1.1 %
    assert found == pytest.approx(variance, rel=0.02)


@pytest.mark.parametrize(
    ("cut", "normalization", "variance"),
    [
        ("slice", "exact", 1.0),
        ("projected", "exact", 1.0),
        ("projected", "paper", 0.305310 / 0.296),
    ],
)
def test_the_variance_of_a_cut_is_that_of_the_filters(cut, normalization, variance):
    fields = {"frequency": 32, "cut": cut, "normalization": normalization}
    depths = [0.011, 0.107, 0.203, 0.303, 0.411, 0.501, 0.611, 0.709]

    found = np.mean([noise((128, 128), **fields, depth=depth).var() for depth in depths])

    # 8 x 4096 coefficients, a band holds about half; where a cut lies between them matters, too
    assert found == pytest.approx(variance, rel=0.05)


def test_t63_a_projection_leaks_less_into_coarser_bands_than_a_slice():
    leaks = {}
    for cut in ("slice", "projected", "plane"):
        pixels = noise((512, 512), frequency=32, cut=cut, depth=0.3713)
        energy = abs(np.fft.fft2(pixels)) ** 2
        waves = np.fft.fftfreq(512, 1 / 512) / 64
        radius = np.hypot(waves[:, np.newaxis], waves)
        leaks[cut] = energy[radius < 0.13].sum() / energy.sum()

    # Measured over seeds: 7.7 %, 0.8 % and 0.0025 %
    assert leaks["plane"] < 1e-4
    assert leaks["projected"] < 0.015 < 0.04 < leaks["slice"]


@pytest.mark.parametrize("cut", ["slice", "projected"])
def test_a_plane_that_does_not_lean_is_what_its_points_have(cut):
    spec = WaveletSpec(technique="wavelet", frequency=5, cut=cut, depth=0.37, seed=4)
    u, v = np.meshgrid((np.arange(40) + 0.5) / 40, 1 - (np.arange(30) + 0.5) / 30)
    places = np.stack([u.ravel(), v.ravel(), np.full(1200, 0.37)], axis=-1)

    pixels = synthesize(spec, (40, 30), {}, silent).pixels[..., 0]

    expected = noise_at(spec, places, np.tile([0.0, 0.0, 1.0], (1200, 1)), 30)
    assert pixels.ravel() == pytest.approx(expected, abs=2e-6)


def test_a_leaning_plane_approaches_the_one_that_does_not():
    fields = {"frequency": 5, "cut": "projected", "depth": 0.37, "seed": 4}

    straight = noise((32, 32), **fields)
    leaning = noise((32, 32), **fields, tilt=[1e-6, 0.7])

    # 1e-6 radians move the plane's corners by 7e-6 of ten coefficients
    assert leaning == pytest.approx(straight, abs=1e-3)


def test_voxels_are_what_their_points_have():
    spec = WaveletSpec(technique="wavelet", frequency=3, bands=2, seed=6)
    w, v, u = np.meshgrid(*[(np.arange(n) + 0.5) / n for n in (24, 25, 26)], indexing="ij")
    places = np.stack([u.ravel(), 1 - v.ravel(), w.ravel()], axis=-1)

    voxels = synthesize_volume(spec, (26, 25, 24), {}, silent).voxels

    expected = noise_at(spec, places, np.zeros_like(places), 24)
    assert voxels.ravel() == pytest.approx(expected, abs=2e-6)


def test_a_solid_joins_its_opposite_faces():
    cube = solid((24, 24, 24), frequency=3)

    for axis in range(3):
        seam = abs(np.take(cube, 0, axis) - np.take(cube, -1, axis)).max()
        assert seam <= abs(np.diff(cube, axis=axis)).max() * 1.2


def test_the_spline_of_a_projection_is_that_of_the_published_code():
    # The same loops as printed, of a unit coefficient at the origin
    coefficients = np.zeros((16, 16, 16), np.float32)
    coefficients[0, 0, 0] = 1
    rng = np.random.default_rng(1)
    normals = rng.normal(size=(50, 3))
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    places = rng.uniform(-2, 2, (50, 3))
    expected = np.ones(50)
    for n, (p, normal) in enumerate(zip(places, normals, strict=True)):
        dot = normal @ p
        for axis in range(3):
            t = normal[axis] * dot / 2 - (p[axis] - 1.5)
            t1, t2, t3 = t - 1, 2 - t, 3 - t
            if t <= 0 or t >= 3:
                weight = 0.0
            elif t < 1:
                weight = t * t / 2
            else:
                weight = 1 - (t1 * t1 + t2 * t2) / 2 if t < 2 else t3 * t3 / 2
            expected[n] *= weight

    found = np.zeros(50)
    fill_projected_at(found, places, normals, coefficients)

    assert found == pytest.approx(expected, abs=1e-12)
    assert np.count_nonzero(expected) > 10


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
