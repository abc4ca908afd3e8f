"""Improved noise against its published values (T47)."""

import json

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from worker.synthesis._perlin_points import (
    FADES,
    GRADIENTS,
    GRADIENTS_2D,
    gradient_noise,
    hashed,
    noise3,
)
from worker.synthesis._permutation import permutation

TABLE = permutation(0)
QUINTIC = FADES["quintic"]
lattice = st.integers(-300, 300)
coordinate = st.floats(-300, 300)

# Perlin 2002, in the order of the hash; the last four fill up sixteen
EDGES = [
    (1, 1, 0), (-1, 1, 0), (1, -1, 0), (-1, -1, 0), (1, 0, 1), (-1, 0, 1), (1, 0, -1), (-1, 0, -1),
    (0, 1, 1), (0, -1, 1), (0, 1, -1), (0, -1, -1), (1, 1, 0), (0, -1, 1), (-1, 1, 0), (0, -1, -1),
]  # fmt: skip


def noise(place, name="eight", layer=0, period=256, beats=256, fade="quintic", gradients=None):
    """Noise and its derivatives at a place of 2, 3 or 4 numbers."""
    where, slope = np.zeros(4), np.empty(4)
    where[: len(place)] = place
    vectors = GRADIENTS[name] if gradients is None else gradients
    value = gradient_noise(
        where,
        len(place),
        layer,
        period,
        beats,
        TABLE,
        vectors,
        FADES[fade],
        slope,
        np.empty((4, 4)),
    )
    return value, slope[: len(place)]


def test_the_value_everybody_quotes_comes_out_to_the_last_digit():
    assert noise3(3.14, 42.0, 7.0, TABLE) == 0.13691995878400012


@pytest.mark.parametrize(
    ("x", "y", "z", "value"),
    [
        (0.5, 0.5, 0.5, -0.25),
        (1.5, 1.5, 0.0, 0.5),
        (3.0, 4.0, 5.0, 0.0),
        (-4.2, 10.0, 6.0, 0.14208),
        (0.1, 0.1, 0.1, 0.1861607143544832),
        (1.5, 2.25, 3.75, -0.23534488677978516),
        (-1.3, 2.7, 100.1, 0.22850249731000208),
    ],
)
def test_known_values(x, y, z, value):
    assert noise3(x, y, z, TABLE) == pytest.approx(value, abs=1e-12)


@pytest.mark.corpus
def test_published_values(corpus):
    reference = json.loads((corpus / "5_reference/noise/perlin_improved.json").read_text())

    for x, y, z, value in reference["values"]:
        assert noise3(float(x), float(y), float(z), TABLE) == pytest.approx(value, abs=1e-15)


@given(lattice, lattice, lattice)
def test_noise_is_zero_on_the_lattice(i, j, k):
    assert noise3(float(i), float(j), float(k), TABLE) == 0.0


def test_the_slope_at_a_lattice_point_is_its_gradient_in_the_published_order():
    step = 2.0**-12
    seen = set()
    for i, j in np.ndindex(16, 16):
        number = hashed(i, j, 0, TABLE) & 15
        slopes = [
            noise3(i + step * dx, j + step * dy, step * dz, TABLE) / step
            for dx, dy, dz in np.eye(3)
        ]
        # The fade contributes its 10 s^3 times a difference of corners below 3, over s
        assert slopes == pytest.approx(EDGES[number], abs=30 * step**2)
        seen.add(number)
    assert set(range(16)) == seen


def test_noise_stays_below_its_supremum():
    points = np.random.default_rng(1).uniform(-100, 100, (50_000, 3))

    values = np.array([noise3(x, y, z, TABLE) for x, y, z in points])

    # 1.03635381121 at (.35526, .5, .48149) of a cell with the worst gradients (T47)
    assert abs(values).max() <= 1.0364
    # Measured on 1e5 points elsewhere: .271
    assert values.std() == pytest.approx(0.271, abs=0.01)


@given(st.integers(0, 2**20), st.integers(0, 2**20), st.integers(-3, 3))
def test_noise_repeats_after_256_cells(a, b, turns):
    x, y = a * 2.0**-12, b * 2.0**-12

    assert noise3(x + 256.0 * turns, y, 0.25, TABLE) == noise3(x, y, 0.25, TABLE)


@given(coordinate, coordinate, st.integers(0, 255))
def test_reference_noise_in_the_plane_is_a_slice_of_the_noise_in_space(x, y, layer):
    plane, _ = noise((x, y), "reference", layer)

    # The quintic is summed in another order: a few roundings of numbers below 2
    assert plane == pytest.approx(noise3(x, y, float(layer), TABLE), abs=4e-15)


@given(coordinate, coordinate, coordinate)
def test_solid_noise_is_the_noise_of_2002(x, y, z):
    assert noise((x, y, z), "solid")[0] == pytest.approx(noise3(x, y, z, TABLE), abs=4e-15)


@given(
    st.integers(1, 300),
    st.integers(1, 9),
    st.lists(st.integers(0, 2**12), min_size=4, max_size=4),
    st.integers(-2, 2),
)
def test_noise_has_any_integer_period_along_every_axis(period, beats, units, turns):
    place = np.array(units) * 2.0**-6
    for axes, name in ((2, "eight"), (3, "solid"), (4, "time")):
        for axis in range(axes):
            moved = place[:axes].copy()
            moved[axis] += turns * (beats if axis == 3 else period)

            options = {"name": name, "period": period, "beats": beats}
            assert noise(moved, **options)[0] == noise(place[:axes], **options)[0]


@pytest.mark.parametrize("fade", ["quintic", "cubic", "linear"])
@pytest.mark.parametrize(
    ("axes", "name"), [(2, "eight"), (2, "reference"), (3, "solid"), (4, "time")]
)
def test_derivatives_are_the_limits_of_differences(axes, name, fade):
    step = 2.0**-16
    for place in np.random.default_rng(axes).uniform(-9, 9, (40, axes)):
        _, slope = noise(place, name, fade=fade)

        for axis in range(axes):
            ahead, behind = place.copy(), place.copy()
            ahead[axis] += step
            behind[axis] -= step
            difference = noise(ahead, name, fade=fade)[0] - noise(behind, name, fade=fade)[0]
            # The error of a central difference is its third derivative, below 600, times step^2/6
            assert slope[axis] == pytest.approx(difference / (2 * step), abs=100 * step**2 + 1e-10)


def test_the_derivative_at_a_lattice_point_is_its_gradient():
    # T47: grad noise(0,0,0) = (1,0,1), grad noise(1,2,3) = (0,1,-1)
    assert noise((0.0, 0.0, 0.0), "solid")[1].tolist() == [1, 0, 1]
    assert noise((1.0, 2.0, 3.0), "solid")[1].tolist() == [0, 1, -1]


def test_time_has_the_32_edges_of_a_hypercube():
    edges = {tuple(edge) for edge in GRADIENTS["time"]}

    assert len(edges) == 32
    assert all(sorted(map(abs, edge)) == [0, 1, 1, 1] for edge in edges)


@given(lattice, lattice, lattice, lattice)
def test_noise_in_space_and_time_is_zero_on_the_lattice(i, j, k, moment):
    assert noise((float(i), float(j), float(k), float(moment)), "time")[0] == 0


def test_eight_gradients_are_unit_vectors_45_degrees_apart():
    angles = np.arange(8) * np.pi / 4

    assert GRADIENTS_2D["eight"] == pytest.approx(
        np.stack([np.cos(angles), np.sin(angles)], axis=1), abs=1e-15
    )


@pytest.mark.parametrize(
    ("name", "blend"),
    [
        ("quintic", lambda s: 6 * s**5 - 15 * s**4 + 10 * s**3),
        ("cubic", lambda s: 3 * s**2 - 2 * s**3),
        ("linear", lambda s: s),
    ],
)
def test_fades_are_the_published_polynomials(name, blend):
    # With all gradients (1, 0), noise(s, 0) = (1 - a) s + a (s - 1) = s - a(s)
    flat = np.array([[1.0, 0.0, 0.0, 0.0]])
    for s in np.linspace(0, 1, 17, endpoint=False):
        value, _ = noise((s, 0.0), gradients=flat, fade=name)
        # The terms of the polynomial reach 15 before they cancel
        assert value == pytest.approx(s - blend(s), abs=1e-14)
