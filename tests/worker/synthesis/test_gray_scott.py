"""Reaction and diffusion against steady states, lattice modes and conservation laws."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from api_schemas.textures.gray_scott import GrayScottSpec
from worker.stages import silent
from worker.synthesis.gray_scott import initial_dish, react, synthesize


def spec(**fields):
    return GrayScottSpec(technique="gray_scott", **fields)


def flat(u, v):
    return np.full((20, 24), u, np.float32), np.full((20, 24), v, np.float32)


@pytest.mark.parametrize(
    ("feed", "kill", "u", "v"),
    [
        (0.04, 0.05, 0.717944947, 0.125357801),
        (0.04, 0.05, 0.282055053, 0.319086643),
        (0.04, 0.06, 0.5, 0.2),
        (0.04, 0.06, 1.0, 0.0),
    ],
)
def test_steady_states_stay(feed, kill, u, v):
    after = react(*flat(u, v), spec(feed=feed, kill=kill, steps=1))

    # Five float32 operations round numbers below 1 by 2^-25 each
    assert after[0] == pytest.approx(u, abs=1.5e-7)
    assert after[1] == pytest.approx(v, abs=1.5e-7)


@pytest.mark.parametrize(
    ("feed", "kill", "expected"),
    [
        (0.04, 0.05, [(0.717944947, 0.125357801), (0.282055053, 0.319086643)]),
        (0.04, 0.061, []),
        (0.0, 0.0, []),
        (1e-3, 1e-9, [(0.998998996, 0.001001003), (0.001001004, 0.998997997)]),
        (0.1, 0.0, [(0.887298335, 0.112701665), (0.112701665, 0.887298335)]),
    ],
)
def test_a12_the_job_tells_where_the_chemicals_may_stay(feed, kill, expected):
    told = synthesize(spec(feed=feed, kill=kill, steps=0), (8, 8), {}, silent).report

    found = [(state["u"], state["v"]) for state in told["steady_states"]]
    assert found[0] == (1, 0)
    assert np.array(found[1:]).ravel() == pytest.approx(np.array(expected).ravel(), abs=1e-8)
    for u, v in found:
        assert -u * v * v + feed * (1 - u) == pytest.approx(0, abs=1e-12)
        assert u * v * v - (feed + kill) * v == pytest.approx(0, abs=1e-12)


def test_a12_two_steady_states_meet_where_they_appear():
    told = synthesize(spec(feed=0.04, kill=0.06, steps=0), (8, 8), {}, silent).report

    _, *meeting = told["steady_states"]
    for state in meeting:
        assert [state["u"], state["v"]] == pytest.approx([0.5, 0.2], abs=1e-6)
    assert meeting


def test_what_is_no_steady_state_moves():
    after = react(*flat(0.6, 0.25), spec(feed=0.04, kill=0.05, steps=1))

    # One step of du/dt = -.0375 + .016, dv/dt = .0375 - .0225, to first order in 1
    assert after[0][0, 0] - 0.6 == pytest.approx(-0.0215, rel=0.15)
    assert after[1][0, 0] - 0.25 == pytest.approx(0.015, rel=0.15)


def test_without_feed_and_kill_no_molecule_is_lost():
    fields = spec(feed=0.0, kill=0.0, steps=300, size=[64, 48], drops=5)
    u, v = initial_dish(fields)

    after_u, after_v = react(u, v, fields)

    # A step rounds by at most 2^-24 of the sum, all to one side at the worst
    assert (after_v - v).sum() > 1
    assert (after_u + after_v).sum(dtype=np.float64) == pytest.approx(
        (u + v).sum(dtype=np.float64), rel=300 * 2**-24
    )


@pytest.mark.parametrize(("chemical", "diffusion"), [(0, "diffusion_u"), (1, "diffusion_v")])
def test_a_wave_fades_as_the_lattice_says(chemical, diffusion):
    # Mode (3, 2) of 24 x 20 cells: q = 4 sin^2(pi 3 / 24) + 4 sin^2(pi 2 / 20)
    q = 4 * np.sin(np.pi * 3 / 24) ** 2 + 4 * np.sin(np.pi * 2 / 20) ** 2
    x, y = np.meshgrid(np.arange(24) / 24, np.arange(20) / 20)
    wave = np.cos(2 * np.pi * (3 * x + 2 * y))
    dish = [np.zeros((20, 24), np.float32) for _ in range(2)]
    dish[chemical] = (0.5 + 0.25 * wave).astype(np.float32)

    after = react(*dish, spec(feed=0.0, kill=0.0, steps=20, **{diffusion: 0.15}))

    expected = 0.5 + 0.25 * (1 - 0.15 * q) ** 20 * wave
    # Twenty steps of six roundings below 2^-24
    assert after[chemical] == pytest.approx(expected, abs=20 * 6 * 2**-25)
    assert (after[1 - chemical] == 0).all()


def test_without_u_the_other_is_taken_out_at_feed_plus_kill():
    _, v = react(*flat(0.0, 0.5), spec(feed=0.0, kill=0.1, steps=10))

    assert v == pytest.approx(0.5 * 0.9**10, rel=1e-6)


@given(
    st.fixed_dictionaries(
        {
            "size": st.lists(st.integers(16, 40), min_size=2, max_size=2),
            "steps": st.integers(0, 300),
            "feed": st.floats(0, 0.1),
            "kill": st.floats(0, 0.1),
            "diffusion_u": st.floats(0, 0.25),
            "diffusion_v": st.floats(0, 0.2),
            "drops": st.integers(1, 200),
        }
    )
)
def test_every_valid_choice_stays_within_its_bounds(fields):
    dish = initial_dish(spec(**fields))
    u, v = react(*dish, spec(**fields))

    def weight(u, v):
        return ((1 + fields["feed"]) * u.astype(np.float64) + v).mean()

    assert u.min() >= -1e-6
    assert v.min() >= 0
    # Each of up to 300 steps may round up by 2^-23
    limit = max(weight(*dish), 1 + fields["feed"])
    assert weight(u, v) <= limit * (1 + 300 * 2**-23)


def test_much_kill_leaves_nothing_and_the_defaults_leave_a_pattern():
    gone = react(*initial_dish(spec()), spec(size=[64, 64], feed=0.03, kill=0.08, steps=2000))[1]
    u, v = react(*initial_dish(spec(size=[96, 96], drops=4)), spec(steps=3000))

    assert (gone == 0).all()
    assert v.std() > 0.05
    assert 0 < np.corrcoef(u.ravel(), v.ravel())[0, 1] + 1 < 0.3


def test_a_dish_has_no_edges():
    fields = spec(size=[37, 50], steps=40)
    u, v = initial_dish(fields)

    still = react(u, v, fields)[1]
    moved = react(np.roll(u, (20, 15), (0, 1)), np.roll(v, (20, 15), (0, 1)), fields)[1]

    assert np.roll(still, (20, 15), (0, 1)).tobytes() == moved.tobytes()


def test_a_picture_is_the_dish_brought_to_its_size():
    fields = spec(size=[64, 32], steps=50)
    dish = react(*initial_dish(fields), fields)[1]

    same = synthesize(fields, (64, 32), {}, silent).image.pixels[..., 0]
    small = synthesize(fields, (32, 16), {}, silent).image.pixels[..., 0]

    assert same.tobytes() == dish.tobytes()
    assert small == pytest.approx(dish.reshape(16, 2, 32, 2).mean(axis=(1, 3)), abs=1e-7)


def test_pixels_do_not_depend_on_the_number_of_threads(with_threads):
    fields = spec(size=[130, 101], steps=100)

    one = with_threads(1, lambda: react(*initial_dish(fields), fields)[1])
    two = with_threads(2, lambda: react(*initial_dish(fields), fields)[1])

    assert one.tobytes() == two.tobytes()
