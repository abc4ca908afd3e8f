"""Reliefs that the eye looks into (X03), on planes seen aslant."""

from typing import Any

import numpy as np
import pytest

from tests.worker.rendering.studio import Pixels, Studio

pytestmark = pytest.mark.gl

DEPTH = 0.1
METHODS = ["offset", "occlusion"]


def coordinates(studio: Studio, angle: float, heights: Any, **how: Any) -> Pixels:
    """See (u, v) as red and green on a plane of side 2, with an eye `angle` from its normal.

    The eye is moved towards +x: it looks to the left.
    """
    ramps = studio.texture([[[0, 1, 0], [1, 1, 0]], [[0, 0, 0], [1, 0, 0]]])
    half = {"scale": [0.5, 0.5], "offset": [0.25, 0.25]}
    color = {"texture": ramps, "transform": half, "filter": "bilinear"}
    parallax = {"texture": studio.texture(heights), "depth": DEPTH, **how}
    eye = [4 * np.sin(angle), 0.0, 4 * np.cos(angle)]
    camera = {"type": "orthographic", "height": 0.5, "pose": {"eye": eye}}
    surface = {"technique": "unlit", "color": color, "parallax": parallax}
    node = {"mesh": {"type": "plane"}, "surface": surface}
    return studio.draw({"camera": camera, "nodes": [node]}, (9, 9))[..., :2]


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("degrees", [0, 30, 60])
def test_a_floor_at_the_full_depth_is_shifted_by_the_tangent(
    studio: Studio, method: str, degrees: int
) -> None:
    angle = np.radians(degrees)

    seen = coordinates(studio, angle, np.zeros((4, 4)), method=method)[4, 4]

    shift = DEPTH * np.tan(angle)  # .057735027 at 30 degrees
    assert degrees != 30 or shift == pytest.approx(0.057735027, abs=1e-9)
    np.testing.assert_allclose(seen, [0.5 - shift / 2, 0.5], atol=2e-6)


@pytest.mark.parametrize("method", METHODS)
def test_what_lies_on_the_surface_stays_in_place(studio: Studio, method: str) -> None:
    high, flat = np.ones((4, 4)), np.zeros((4, 4))

    seen = coordinates(studio, 0.7, high, method=method)

    np.testing.assert_allclose(seen, coordinates(studio, 0.7, flat, depth=0.0), atol=1e-6)


@pytest.mark.parametrize("steps", [3, 32])
def test_a_ray_meets_a_slope_where_geometry_says(studio: Studio, steps: int) -> None:
    # The relief falls from 1 at u = 0 to 0 at u = 1: depth .1 u below a plane 2 wide. A ray that
    # has come aside by x lies x / tan below the surface, and hits where x / tan = .1 (u - x / 2).
    u = (np.arange(256) + 0.5) / 256
    how = {"method": "occlusion", "wrap": ["clamp", "clamp"], "filter": "bilinear", "steps": steps}
    angle = np.radians(50)

    seen = coordinates(studio, angle, np.tile(1 - u, (2, 1)), **how)[4, 4]

    tangent = np.tan(angle)
    aside = 0.1 * 0.5 * tangent / (1 + 0.05 * tangent)
    np.testing.assert_allclose(seen, [0.5 - aside / 2, 0.5], atol=2e-5)


def test_one_shift_is_by_the_depth_found_first(studio: Studio) -> None:
    u = (np.arange(256) + 0.5) / 256
    how = {"method": "offset", "wrap": ["clamp", "clamp"], "filter": "bilinear"}
    angle = np.radians(50)

    seen = coordinates(studio, angle, np.tile(1 - u, (2, 1)), **how)[4, 4]

    np.testing.assert_allclose(seen, [0.5 - 0.1 * 0.5 * np.tan(angle) / 2, 0.5], atol=2e-5)


def test_a_wall_hides_what_lies_behind_it(studio: Studio) -> None:
    # A wall from u = .44 to .46 stands before the eye at u = .5, which looks to the left under it.
    u = (np.arange(1024) + 0.5) / 1024
    wall = np.where((u > 0.44) & (u < 0.46), 1.0, 0.0)
    how = {"wrap": ["clamp", "clamp"], "filter": "nearest", "steps": 128}
    angle = np.radians(60)

    hidden = coordinates(studio, angle, np.tile(wall, (2, 1)), method="occlusion", **how)[4, 4]
    through = coordinates(studio, angle, np.tile(wall, (2, 1)), method="offset", **how)[4, 4]

    # A step is .1 tan / 2 / 128 = .0007 of u.
    assert hidden[0] == pytest.approx(0.46, abs=1.5e-3)
    assert through[0] == pytest.approx(0.5 - DEPTH * np.tan(angle) / 2, abs=1e-4)


def test_all_maps_are_read_aside(studio: Studio) -> None:
    tilted = studio.texture(np.float32([[[0, 0, 1.0]], [[0.6, 0, 0.8]]]))
    normal = {"texture": tilted, "range": "signed", "filter": "nearest", "wrap": ["clamp", "clamp"]}
    floor = {"texture": studio.texture(np.zeros((2, 2))), "depth": 0.5}
    surface = {"technique": "unlit", "normal": normal, "parallax": floor}
    eye = {"eye": [0.0, 4 * np.sin(0.5), 4 * np.cos(0.5)]}
    camera = {"type": "orthographic", "height": 0.4, "pose": eye}
    node = {"mesh": {"type": "plane"}, "surface": surface}

    seen = studio.layers({"camera": camera, "nodes": [node]}, ["normal"], (9, 9))["normal"]

    # From above the ray goes down on to the lower half of the picture.
    np.testing.assert_allclose(seen[4, 4], [0.6, 0, 0.8], atol=1e-5)


def test_a_stretched_node_is_as_deep_as_it_is_stretched(studio: Studio) -> None:
    angle = np.radians(30)
    ramps = studio.texture([[[0, 1, 0], [1, 1, 0]], [[0, 0, 0], [1, 0, 0]]])
    half = {"scale": [0.5, 0.5], "offset": [0.25, 0.25]}
    surface = {
        "technique": "unlit",
        "color": {"texture": ramps, "transform": half, "filter": "bilinear"},
        "parallax": {"texture": studio.texture(np.zeros((2, 2))), "depth": DEPTH},
    }
    camera = {
        "type": "orthographic",
        "height": 0.5,
        "pose": {"eye": [4 * np.sin(angle), 0.0, 4 * np.cos(angle)]},
    }
    scaled = {"mesh": {"type": "plane"}, "surface": surface, "transform": {"scale": [4, 4, 2.0]}}

    seen = studio.draw({"camera": camera, "nodes": [scaled]}, (9, 9))[4, 4, 0]

    assert seen == pytest.approx(0.5 - 2 * DEPTH * np.tan(angle) / 8, abs=2e-6)


def test_seen_from_inside_there_is_nothing_to_look_into(studio: Studio) -> None:
    floor, none = np.zeros((2, 2)), np.ones((2, 2))

    np.testing.assert_array_equal(
        coordinates(studio, np.radians(150), floor), coordinates(studio, np.radians(150), none)
    )


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("bad", [np.nan, np.inf, -np.inf])
def test_heights_that_are_no_numbers_leave_numbers(studio: Studio, method: str, bad: float) -> None:
    assert np.isfinite(coordinates(studio, 1.5, np.full((2, 2), bad), method=method)).all()
