"""Which steps of a reaction are refused, and why: the checkerboard of REFERENCE T50."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from pydantic import TypeAdapter

from api_schemas.eigenvalues import eigenvalues
from api_schemas.feasibility import obstacles
from api_schemas.members import Texture
from api_schemas.requests import TextureRequest


def spec(name, **fields):
    return TypeAdapter(Texture).validate_python({"technique": name, **fields})


def bound(described):
    (refusal,) = described.refusals()
    assert refusal.code == "time_step_unstable"
    return float(refusal.message.rsplit(" ", 1)[1])


@pytest.mark.parametrize("diffusion", [0.01, 0.25, 2.0])
def test_of_diffusion_alone_the_bound_is_a_quarter_of_its_inverse(diffusion):
    described = spec(
        "schnakenberg", speed=0.0, diffusion_u=diffusion, diffusion_v=0.001, time_step=10.0
    )
    if 0.25 / diffusion >= 10:
        assert list(described.refusals()) == []
    else:
        assert bound(described) == pytest.approx(0.25 / diffusion, rel=1e-5)


def test_t50_turks_own_numbers_are_refused_in_two_dimensions():
    # On a checkerboard mu = -1.116: the longest step is 2 / 2.116
    described = spec("turing", speed=1 / 32, diffusion_a=1 / 4, diffusion_b=1 / 16)

    assert bound(described) == pytest.approx(2 / 2.116, rel=5e-4)


def test_t50_with_reaction_the_bound_on_diffusion_is_about_a_quarter_less_half_the_speed():
    fits = spec("turing", speed=0.1, diffusion_a=0.19, diffusion_b=0.03)
    fails = spec("turing", speed=0.1, diffusion_a=0.21, diffusion_b=0.03)

    assert list(fits.refusals()) == []
    assert bound(fails) < 1


def test_t50_the_whole_dish_beats_beyond_a_speed_of_a_quarter():
    # |mu|^2 = 1 - s + 4 s^2 of the dish as a whole
    assert list(spec("turing", speed=0.249, diffusion_a=0.01).refusals()) == []
    assert bound(spec("turing", speed=0.26, diffusion_a=0.01)) == pytest.approx(0.25 / 0.26)


def test_a_map_is_taken_at_both_ends_of_its_range():
    texture = {"technique": "perlin"}
    fits = {"texture": texture, "range": [0.0, 0.2]}
    fails = {"texture": texture, "range": [0.5, 0.0]}

    assert list(spec("turing", diffusion_a=fits).refusals()) == []
    assert bound(spec("turing", diffusion_a=fails)) < 0.51


@pytest.mark.parametrize(
    ("name", "fields"),
    [
        ("turing", {"beta": 16.0}),
        ("turing", {"beta": {"texture": {"technique": "perlin"}, "range": [10.0, 20.0]}}),
        ("schnakenberg", {"a": 0.0, "b": 0.0}),
        ("brusselator", {"a": 0.0}),
        ("meinhardt_spots", {"beta": 0.0}),
        ("meinhardt_stripes", {"decay": 0.0}),
    ],
)
def test_what_is_nowhere_at_rest_is_refused(name, fields):
    (refusal,) = spec(name, **fields).refusals()

    assert refusal.code == "no_steady_state"


def test_a_refusal_points_into_the_request():
    body = {
        "texture": {
            "technique": "ramp",
            "input": {"technique": "turing", "time_step": 9.0},
            "stops": [{"position": 0, "color": [0, 0, 0]}],
        }
    }

    (obstacle,) = obstacles(TextureRequest.model_validate(body))

    assert obstacle.pointer == "/texture/input/time_step"
    assert "the longest stable one is 1.91" in obstacle.message


@given(
    st.integers(1, 5).flatmap(
        lambda n: st.lists(
            st.lists(st.floats(-9, 9), min_size=n, max_size=n), min_size=n, max_size=n
        )
    )
)
def test_eigenvalues_are_those_of_numpy(matrix):
    ours = np.array(eigenvalues(matrix))
    theirs = np.linalg.eigvals(matrix)

    # Where k of them meet they are known to the k-th root of rounding
    scale = max(1.0, np.abs(np.array(matrix)).max())
    distances = np.abs(ours[:, np.newaxis] - theirs)
    assert distances.min(axis=0).max() < 0.02 * scale
    assert distances.min(axis=1).max() < 0.02 * scale


def test_eigenvalues_far_apart_are_found_to_a_billionth():
    assert sorted(value.real for value in eigenvalues([[2.0, 1.0], [0.0, -3.0]])) == pytest.approx(
        [-3, 2], rel=1e-9
    )
    assert sorted(value.imag for value in eigenvalues([[0.0, 4.0], [-4.0, 0.0]])) == pytest.approx(
        [-4, 4], rel=1e-9
    )
