"""Normals that are the shape's own (T11)."""

from typing import Any

import numpy as np
import pytest

from tests.worker.rendering.studio import Studio
from tests.worker.rendering.test_bump_maps import TOLERANCE, seen_normals, unit
from tests.worker.rendering.test_vertex_arrays import SQUARE

pytestmark = pytest.mark.gl

OWN = unit([0.3, 0.5, 0.4])


def own(studio: Studio, held: Any, **how: Any) -> dict[str, Any]:
    texture = studio.texture(np.float32([[held]]))
    return {"normal": {"texture": texture, "space": "object", "range": "signed", **how}}


@pytest.mark.parametrize("length", [1.0, 0.1, 1e20])
def test_the_picture_is_the_normal_whatever_its_length(studio: Studio, length: float) -> None:
    seen = seen_normals(studio, own(studio, length * OWN))

    np.testing.assert_allclose(seen[4, 4], OWN, atol=TOLERANCE)


def test_eight_bits_are_within_a_hair_of_the_normal(studio: Studio) -> None:
    held = np.rint((OWN + 1) / 2 * 255) / 255

    seen = seen_normals(studio, own(studio, held, range="unit"))[4, 4].astype(np.float64)

    # Each component is within 1/255 of its own: sqrt(3) / 255 = .0068 rad in all, .39 degrees.
    assert np.arccos(min(1.0, seen @ OWN)) <= np.sqrt(3) / 255


def test_down_is_the_mirror_of_up_and_twice_mirrored_is_itself(studio: Studio) -> None:
    mirrored = OWN * [1, -1, 1]

    down = seen_normals(studio, own(studio, OWN, green="down"))
    twice = seen_normals(studio, own(studio, mirrored, green="down"))

    np.testing.assert_allclose(down[4, 4], mirrored, atol=TOLERANCE)
    np.testing.assert_allclose(twice[4, 4], OWN, atol=TOLERANCE)


def test_it_turns_with_the_shape_and_not_with_the_picture(studio: Studio) -> None:
    quarter = {"rotation": [0.0, 0.0, np.sqrt(0.5), np.sqrt(0.5)]}
    surface = own(studio, OWN, transform={"rotation": 1.0})

    seen = seen_normals(studio, surface, transform=quarter)

    np.testing.assert_allclose(seen[4, 4], [-OWN[1], OWN[0], OWN[2]], atol=TOLERANCE)


def test_stretching_the_shape_leans_its_normals_the_other_way(studio: Studio) -> None:
    seen = seen_normals(studio, own(studio, OWN), transform={"scale": [2.0, 1.0, 1.0]})

    np.testing.assert_allclose(seen[4, 4], unit(OWN / [2, 1, 1]), atol=TOLERANCE)


@pytest.mark.parametrize("strength", [0.0, 0.25, 1.0])
def test_strength_lies_between_the_shape_and_the_picture(studio: Studio, strength: float) -> None:
    seen = seen_normals(studio, own(studio, OWN, strength=strength))

    expected = unit((1 - strength) * np.array([0, 0, 1]) + strength * OWN)
    np.testing.assert_allclose(seen[4, 4], expected, atol=TOLERANCE)


@pytest.mark.parametrize("held", [[0.0, 0.0, 0.0], [np.nan, 0.0, 1.0], [np.inf, 0.0, 1.0]])
def test_where_there_is_no_direction_the_shape_keeps_its_own(studio: Studio, held: Any) -> None:
    np.testing.assert_allclose(seen_normals(studio, own(studio, held))[4, 4], [0, 0, 1], atol=1e-6)


def test_it_needs_no_directions_of_u_and_v(studio: Studio) -> None:
    seen = seen_normals(studio, own(studio, OWN), mesh=studio.mesh(SQUARE))

    np.testing.assert_allclose(seen[4, 4], OWN, atol=TOLERANCE)
