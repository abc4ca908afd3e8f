"""Pictures of Perlin noise against the noise at points, and against themselves."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from api_schemas.textures.perlin import PerlinSpec
from worker.stages import silent
from worker.synthesis._perlin_grid import axis_table, fill_fractal_noise
from worker.synthesis._perlin_octaves import octaves_of
from worker.synthesis._perlin_points import FADES, GRADIENTS_2D, hashed, noise3
from worker.synthesis._permutation import permutation
from worker.synthesis.perlin import noise_at, synthesize, synthesize_volume

# Float32 rounds the terms of the weighted sum, each below 3: 0.5 * 3 * 2^-23 for the largest and
# about as much for the others together, and their tables as often again.
GRID_ERROR = 1e-6
SUMS = ["fbm", "turbulence", "billow", "ridged", "multifractal"]


def spec(**fields):
    return PerlinSpec(technique="perlin", **fields)


def picture(size, **fields):
    return synthesize(spec(**fields), size, {}, silent).pixels[..., 0]


def centres(size):
    width, height = size
    u, v = np.meshgrid((np.arange(width) + 0.5) / width, 1 - (np.arange(height) + 0.5) / height)
    return np.stack([u.ravel(), v.ravel()], axis=-1)


@given(
    st.tuples(st.integers(1, 70), st.integers(1, 150)),
    st.fixed_dictionaries(
        {
            "frequency": st.integers(1, 40),
            "octaves": st.integers(1, 4),
            "lacunarity": st.integers(2, 3),
            "gain": st.floats(0, 1),
            "seed": st.integers(0, 2**32 - 1),
            "fade": st.sampled_from(["quintic", "cubic", "linear"]),
            "gradients": st.sampled_from(["eight", "reference"]),
            "range": st.sampled_from(["unit", "signed"]),
            "sum": st.sampled_from(SUMS),
            "depth": st.sampled_from([None, 0.0, 0.3, -7.75]),
            "time": st.sampled_from([None, 0.0, 0.6, 1024.0]),
            "beats": st.integers(1, 9),
        }
    ),
)
def test_a_picture_is_the_noise_at_its_pixel_centres(size, fields):
    pixels = picture(size, **fields)

    expected, _ = noise_at(spec(**fields), centres(size), pixels_per_tile=min(size))
    # A multifractal is a product of up to four factors of at most 2; crests are squared and carried
    assert pixels.ravel() == pytest.approx(expected, abs=20 * GRID_ERROR)


def test_the_first_octave_with_reference_gradients_is_the_noise_of_2002_at_z_0():
    pixels = picture((512, 512), frequency=16, gradients="reference", range="signed")

    table = permutation(0)
    for row, column in np.random.default_rng(0).integers(0, 480, (300, 2)):
        x, y = (column + 0.5) / 32, (511.5 - row) / 32
        # The last cells along u and v join the tile's ends
        if x < 15 and y < 15:
            assert pixels[row, column] == pytest.approx(noise3(x, y, 0.0, table), abs=GRID_ERROR)


@pytest.mark.parametrize(("width", "height"), [(96, 64), (100, 37), (2100, 65)])
def test_the_tile_repeats_bit_for_bit(width, height):
    noise = spec(frequency=9, octaves=3, seed=5)
    octaves = octaves_of(noise, 1e9)
    pixels = np.empty((3 * height, 2 * width), np.float32)

    fill_fractal_noise(
        pixels,
        axis_table(octaves, 0, np.arange(2 * width), width, FADES["quintic"]),
        axis_table(octaves, 1, np.arange(3 * height), height, FADES["quintic"]),
        np.array([octave.layer for octave in octaves], np.int32),
        np.array([octave.cells for octave in octaves], np.int32),
        np.array([octave.weight for octave in octaves], np.float32),
        np.float32(0),
        permutation(5),
        GRADIENTS_2D["eight"].astype(np.float32),
    )

    tile = pixels[:height, :width].tobytes()
    for down in range(3):
        for across in range(2):
            copy = pixels[down * height : (down + 1) * height, across * width :][:, :width]
            assert copy.tobytes() == tile


def test_pixels_do_not_depend_on_the_number_of_threads(with_threads):
    fields = {"frequency": 13, "octaves": 4}

    one = with_threads(1, lambda: picture((2200, 300), **fields))
    two = with_threads(2, lambda: picture((2200, 300), **fields))

    assert one.tobytes() == two.tobytes()


def test_opposite_edges_join():
    pixels = picture((256, 256), frequency=4, range="signed")

    # Steps of 1/64 of a cell: no slope of this noise exceeds 2.2 per cell, also across the edges
    for axis in (0, 1):
        seam = np.take(pixels, 0, axis) - np.take(pixels, -1, axis)
        assert abs(seam).max() <= 2.2 / 64
        assert abs(np.diff(pixels, axis=axis)).max() <= 2.2 / 64


@pytest.mark.parametrize(("gradients", "bound"), [("eight", 0.5**0.5), ("reference", 1.0)])
def test_values_stay_within_the_stated_bounds(gradients, bound):
    signed = picture((512, 512), frequency=32, octaves=3, gradients=gradients, range="signed")
    unit = picture((512, 512), frequency=32, octaves=3, gradients=gradients)

    assert abs(signed).max() <= bound
    assert unit == pytest.approx((signed + 1) / 2, abs=1e-6)


@pytest.mark.parametrize("field", [{"seed": 1}, {"fade": "cubic"}, {"gradients": "reference"}])
def test_every_choice_changes_the_picture(field):
    assert (
        picture((64, 64), frequency=8).tobytes()
        != picture((64, 64), frequency=8, **field).tobytes()
    )


def test_two_thirds_of_the_energy_lie_in_one_octave():
    size, cells = 512, 32
    waves = np.fft.fftfreq(size, 1 / size) / cells
    per_cell = np.hypot(waves[:, np.newaxis], waves)
    best = (per_cell >= 0.44) & (per_cell < 0.88)
    shares = []
    for seed in range(24):
        pixels = picture((size, size), frequency=cells, seed=seed, range="signed")
        energy = abs(np.fft.fft2(pixels)) ** 2
        shares.append(energy[best].sum() / energy.sum())

    # 66.9 % for the mean over permutations; 1024 cells of one scatter by 4 %, the mean by .8 %
    assert np.mean(shares) == pytest.approx(0.669, abs=0.02)


def test_t47_the_spectrum_of_a_slice_at_a_whole_place_is_the_one_stated():
    size, cells = 512, 64
    shares = np.zeros(3)
    for seed in range(8):
        pixels = picture(
            (size, size), frequency=cells, gradients="reference", seed=seed, range="signed"
        )
        energy = abs(np.fft.fft2(pixels.astype(np.float64))) ** 2
        waves = np.fft.fftfreq(size, 1 / size) / cells
        radius = np.hypot(waves, waves[:, np.newaxis])
        for index, (low, high) in enumerate([(0.25, 1), (1, 2), (2, 9)]):
            shares[index] += energy[(radius >= low) & (radius < high)].sum() / energy.sum() / 8

    assert shares[0] == pytest.approx(0.93, abs=0.02)
    assert shares[1] == pytest.approx(0.038, abs=0.01)
    assert shares[2] < 5e-4


@pytest.mark.parametrize("gradients", ["eight", "reference"])
def test_t46_on_the_lattice_noise_is_zero_with_the_slope_of_its_gradient(gradients):
    lattice = np.stack(np.meshgrid(np.arange(16), np.arange(16)), axis=-1).reshape(-1, 2)
    fields = {"frequency": 256, "gradients": gradients, "range": "signed"}

    values, slopes = noise_at(spec(**fields), lattice / 256)

    expected = [
        GRADIENTS_2D[gradients][hashed(i, j, 0, permutation(0)) % len(GRADIENTS_2D[gradients])]
        for i, j in lattice
    ]
    assert (values == 0).all()
    assert slopes / 256 == pytest.approx(np.array(expected), abs=1e-12)


@pytest.mark.parametrize("kind", SUMS)
def test_slopes_of_sums_are_the_limits_of_differences(kind):
    noise = spec(frequency=3, octaves=3, sum=kind, time=0.3, depth=0.2)
    places = np.random.default_rng(4).random((200, 2))
    step = 2.0**-18

    _, slopes = noise_at(noise, places)

    for axis in (0, 1):
        ahead, behind = (
            noise_at(noise, places + sign * step * np.eye(2)[axis])[0] for sign in (1, -1)
        )
        differences = (ahead - behind) / (2 * step)
        # Creases of |n|, and where a crest stops letting through, fall into a step now and then
        close = np.isclose(slopes[:, axis], differences, atol=1e-4)
        assert close.mean() > 0.98


@pytest.mark.parametrize(("axes", "made"), [(2, synthesize), (3, synthesize_volume)])
def test_slopes_are_shown_as_they_are_at_pixel_centres(axes, made):
    noise = spec(frequency=3, octaves=2, output="slope")
    size = (9, 8, 7)[:axes]

    shown = made(noise, size, {}, silent)

    numbers = shown.pixels if axes == 2 else shown.voxels
    grid = [(np.arange(count) + 0.5) / count for count in size]
    grid[1] = grid[1][::-1]
    places = np.stack(np.meshgrid(*grid[::-1], indexing="ij")[::-1], axis=-1).reshape(-1, axes)
    assert numbers.reshape(-1, axes) == pytest.approx(
        noise_at(noise, places, 7 + (axes == 2))[1], abs=1e-5
    )


@pytest.mark.parametrize("kind", ["turbulence", "billow", "ridged"])
@pytest.mark.parametrize("gradients", ["eight", "reference", "solid", "time"])
def test_what_fades_leaves_its_mean(kind, gradients):
    fields = {"frequency": 64, "sum": kind, "depth": 0.0 if gradients == "solid" else None}
    fields["time"] = 0.4 if gradients == "time" else None
    fields["gradients"] = gradients if gradients in GRADIENTS_2D else "eight"
    # At many depths, since a whole one is special
    depths = [0.003, 0.1, 0.23, 0.37, 0.49] if gradients == "solid" else [fields["depth"]]

    seen = [picture((512, 512), **fields | {"depth": depth, "seed": 3}) for depth in depths]
    faded = picture((64, 64), **fields)

    assert (faded == faded[0, 0]).all()
    # 4096 cells of each, which deviate by about .15
    assert np.mean(seen) == pytest.approx(faded[0, 0], abs=0.02)


def test_time_returns_to_its_beginning_and_changes_in_between():
    moments = [picture((64, 64), frequency=6, time=time, beats=3) for time in (0.0, 0.5, 1.0, -2.0)]

    assert moments[0].tobytes() == moments[2].tobytes() == moments[3].tobytes()
    assert abs(moments[0] - moments[1]).mean() > 0.02


def test_octaves_are_not_zero_together_on_the_lattice_of_the_first():
    u, v = np.meshgrid(np.arange(8) / 8, np.arange(8) / 8)
    noise = spec(frequency=8, octaves=4, range="signed")

    values, _ = noise_at(noise, np.stack([u.ravel(), v.ravel()], axis=-1))

    assert (abs(values) > 1e-3).mean() > 0.9


def test_an_octave_fades_between_four_and_two_pixels_per_cell():
    fine = spec(frequency=16)

    assert [octave.weight for octave in octaves_of(fine, 64)] == [1.0]
    assert [octave.weight for octave in octaves_of(fine, 48)] == [0.5]
    assert [octave.weight for octave in octaves_of(fine, 32)] == [0.0]
    assert (picture((32, 32), frequency=16) == 0.5).all()


def test_octaves_that_fade_leave_the_others_as_they_are():
    noise = spec(frequency=4, octaves=3, gain=0.5)

    weights = [octave.weight for octave in octaves_of(noise, 32)]

    assert weights == [4 / 7, 2 / 7, 0]


def test_the_finest_octaves_of_the_language_are_survived():
    pixels = picture((64, 64), frequency=4096, octaves=16, lacunarity=8, gain=1.0)
    extreme = spec(frequency=4096, octaves=16, lacunarity=8, gain=1.0)

    assert (pixels == 0.5).all()
    assert np.isfinite(noise_at(extreme, centres((8, 8)))[0]).all()


def test_an_octave_is_its_own_slice_of_the_noise_moved_by_its_own_shift():
    places = np.random.default_rng(3).random((200, 2))
    fields = {"frequency": 128, "gain": 0.25, "gradients": "reference", "range": "signed"}

    first, _ = noise_at(spec(**fields), places)
    both, _ = noise_at(spec(octaves=2, **fields), places)

    table = permutation(0)
    # One step of the R2 sequence in 256ths; the period is that of the noise in space
    second = [noise3(x, y, 1.0, table) for x, y in 256 * places + np.array([193, 145]) / 256]
    assert both * 1.25 == pytest.approx(first + 0.25 * np.array(second), abs=1e-12)
