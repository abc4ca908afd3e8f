"""Longitude and latitude, against the textbook's and OpenEXR's formulas."""

import numpy as np
import pytest

from api_schemas.layouts.latlong import LatlongSpec
from worker import layouts

AXES = np.array([[1.0, 0, 0], [0, 1, 0], [0, 0, 1], [-1, 0, 0], [0, -1, 0], [0, 0, -1]])


def latlong(centre="+z"):
    return LatlongSpec(technique="latlong", centre=centre)


def random_directions(count=1000):
    directions = np.random.default_rng(7).normal(size=(count, 3))
    return directions / np.linalg.norm(directions, axis=1, keepdims=True)


def test_a4_directions_of_the_textbook():
    # A4, T07: +x -> (0, .5), +y -> (*, 1), +z -> (.25, .5), -x -> (.5, .5)
    uv = layouts.place(latlong("-x"), AXES)

    np.testing.assert_allclose(uv[[0, 2, 3]], [[0, 0.5], [0.25, 0.5], [0.5, 0.5]], atol=1e-12)
    assert uv[1, 1] == 1.0
    assert uv[4, 1] == 0.0


@pytest.mark.parametrize("centre", ["+z", "+x", "-z", "-x"])
def test_t21_the_centre_is_in_the_middle_and_what_is_to_its_right_is_at_three_quarters(centre):
    middle = np.array({"x": [1.0, 0, 0], "z": [0, 0, 1.0]}[centre[1]]) * float(centre[0] + "1")
    right = np.cross(middle, [0.0, 1.0, 0.0])

    uv = layouts.place(latlong(centre), np.array([middle, right, -right]))

    np.testing.assert_allclose(uv, [[0.5, 0.5], [0.75, 0.5], [0.25, 0.5]], atol=1e-15)


@pytest.mark.parametrize(
    ("centre", "formula"),
    [
        # REFERENCE 0.3: what programs that write such files say of u
        ("+z", lambda x, z: 0.5 - np.arctan2(x, z) / (2 * np.pi)),
        ("+x", lambda x, z: 0.5 + np.arctan2(z, x) / (2 * np.pi)),
        ("-z", lambda x, z: 0.5 + np.arctan2(x, -z) / (2 * np.pi)),
        ("-x", lambda x, z: np.arctan2(z, x) / (2 * np.pi) % 1.0),
    ],
)
def test_t21_u_is_what_the_programs_of_each_convention_say(centre, formula):
    directions = random_directions()

    u = layouts.place(latlong(centre), directions)[:, 0]

    off = u - formula(directions[:, 0], directions[:, 2])
    np.testing.assert_allclose(off - np.rint(off), 0, atol=1e-15)


@pytest.mark.parametrize("centre", ["+z", "+x", "-z", "-x"])
def test_t21_there_and_back(centre):
    directions = random_directions()

    back, valid = layouts.direction(latlong(centre), layouts.place(latlong(centre), directions))

    assert valid.all()
    np.testing.assert_allclose(back, directions, atol=1e-14)


def test_t21_solid_angles_are_those_of_bands_and_make_a_whole_sphere():
    angles = layouts.solid_angles(latlong(), 16, 8)

    assert angles.sum() == pytest.approx(4 * np.pi, rel=1e-14)
    # (2 pi / W) (sin p1 - sin p0) of the second band from the top: 45 to 67.5 degrees
    band = 2 * np.pi / 16 * (np.sin(np.radians(67.5)) - np.sin(np.radians(45)))
    np.testing.assert_allclose(angles[1], band, rtol=1e-14)


def test_directions_of_any_length_have_a_place_and_u_is_below_one():
    directions = np.array([[1e-200, 0, -1e-220], [1e200, 1e200, 0], [-1.0, 0.0, -0.0]])

    uv = layouts.place(latlong("-x"), directions)

    np.testing.assert_allclose(uv, [[0, 0.5], [0, 0.75], [0.5, 0.5]], atol=1e-12)
    assert (uv[:, 0] < 1).all()
