"""Bump maps against the tilt worked out by hand (T10), and frames that they tilt along."""

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from tests.worker.rendering.studio import Pixels, Studio
from tests.worker.rendering.test_vertex_arrays import SQUARE, UV

pytestmark = pytest.mark.gl

TOLERANCE = 1e-5
CAMERA = {"type": "orthographic", "height": 2.0, "pose": {"eye": [0.0, 0.0, 2.0]}}


def seen_normals(
    studio: Studio, surface: dict[str, Any], size: tuple[int, int] = (8, 8), **node: Any
) -> Pixels:
    """See the normals of a plane, or of another mesh, from +z."""
    placed = {"mesh": {"type": "plane"}, "surface": {"technique": "unlit"} | surface} | node
    return studio.layers({"camera": CAMERA, "nodes": [placed]}, ["normal"], size)["normal"]


def unit(vector: Any) -> np.ndarray:
    return np.asarray(vector) / np.linalg.norm(vector)


def bump(studio: Studio, tilt: Any, **how: Any) -> dict[str, Any]:
    held = {"encoding": "float"} | how
    return {"bump": {"texture": studio.texture(np.float32([[tilt]])), **held}}


def test_a2_full_red_and_green_tilt_to_the_middle_of_the_axes(studio: Studio) -> None:
    seen = seen_normals(studio, bump(studio, [1.0, 1.0]))[4, 4]

    # float32 pixels: 1e-9 is a matter of float64
    np.testing.assert_allclose(seen, np.full(3, 0.577350269), atol=1e-7)
    assert np.degrees(np.arccos(np.float64(seen[2]))) == pytest.approx(54.735610317, abs=2e-5)


@pytest.mark.parametrize("tilt", [(0.3, -0.2), (-1.0, 0.0), (0.0, 5.0), (0.0, 0.0)])
def test_the_tilt_is_the_arc_tangent_of_its_length(
    studio: Studio, tilt: tuple[float, float]
) -> None:
    seen = seen_normals(studio, bump(studio, tilt))

    np.testing.assert_allclose(seen[4, 4], unit([*tilt, 1.0]), atol=TOLERANCE)


def test_range_multiplies_what_a_byte_can_say(studio: Studio) -> None:
    seen = seen_normals(studio, bump(studio, [1.0, 0.0], encoding="unorm8", range=3.0))

    np.testing.assert_allclose(seen[4, 4], unit([3.0, -3.0, 1.0]), atol=TOLERANCE)


def test_a_flat_signed_bump_map_is_no_map(studio: Studio) -> None:
    ball = {"type": "sphere"}
    flat = seen_normals(studio, bump(studio, [0.0, 0.0], encoding="snorm8"), (32, 32), mesh=ball)

    np.testing.assert_allclose(flat, seen_normals(studio, {}, (32, 32), mesh=ball), atol=1e-6)


def test_bytes_are_decoded_before_they_are_blended(studio: Studio) -> None:
    # Between 127 (1) and 128 (-1, two's complement) lies no tilt, though 127.5 would decode as one.
    edge = studio.texture(np.float32([[[127 / 255, 0.0], [128 / 255, 0.0]]]))
    how = {"encoding": "snorm8", "filter": "bilinear", "wrap": ["clamp", "clamp"]}
    middle = {"scale": [0.0, 0.0], "offset": [0.5, 0.5]}

    seen = seen_normals(studio, {"bump": {"texture": edge, "transform": middle, **how}})

    np.testing.assert_allclose(seen[4, 4], [0, 0, 1], atol=TOLERANCE)


@pytest.mark.parametrize("turn", [0.0, np.pi / 2, 1.0])
def test_a_picture_that_lies_turned_has_its_bumps_turned(studio: Studio, turn: float) -> None:
    seen = seen_normals(studio, bump(studio, [1.0, 0.0], transform={"rotation": turn}))

    np.testing.assert_allclose(seen[4, 4], unit([np.cos(turn), -np.sin(turn), 1.0]), atol=TOLERANCE)


@pytest.mark.parametrize("signs", [[-1, 1], [1, -1], [-1, -1]], ids=str)
def test_in_a_mirrored_chart_bumps_are_mirrored(studio: Studio, signs: list[int]) -> None:
    flipped = np.where(np.array(signs) < 0, 1 - UV, UV)
    mesh = studio.mesh(replace(SQUARE, uv_sets=(flipped,)))

    seen = seen_normals(studio, bump(studio, [0.5, 0.25]), mesh=mesh)

    expected = unit([0.5 * signs[0], 0.25 * signs[1], 1.0])
    np.testing.assert_allclose(seen[4, 4], expected, atol=TOLERANCE)


def test_a_bump_map_tilts_what_a_normal_map_has_tilted(studio: Studio) -> None:
    normal = {"texture": studio.texture(np.float32([[[0.6, 0.0, 0.8]]])), "range": "signed"}

    seen = seen_normals(studio, {"normal": normal} | bump(studio, [0.0, 0.5]))

    np.testing.assert_allclose(seen[4, 4], unit([0.6, 0.5, 0.8]), atol=TOLERANCE)


def test_seen_from_inside_a_bump_is_a_dent(studio: Studio) -> None:
    turned = {"rotation": [0.0, 1.0, 0.0, 0.0]}  # half a turn: u grows to the left

    seen = seen_normals(studio, bump(studio, [0.5, 0.2]), transform=turned)

    np.testing.assert_allclose(seen[4, 4], unit([0.5, -0.2, 1.0]), atol=TOLERANCE)


@pytest.mark.parametrize("bad", [np.nan, np.inf, -np.inf, 3e38])
def test_what_is_no_number_still_gives_a_unit_normal(studio: Studio, bad: float) -> None:
    seen = seen_normals(studio, bump(studio, [bad, 0.0]))

    assert np.linalg.norm(seen[4, 4]) == pytest.approx(1, abs=1e-5)


@pytest.mark.parametrize("frames", ["mikktspace", "averaged", "sphere"])
def test_on_a_globe_bumps_tilt_along_parallels_and_meridians(studio: Studio, frames: str) -> None:
    # T14, T15: towards the east along u and towards the north along v, seen at +z
    ball = {"type": "sphere", "segments": 256, "rings": 128}
    surface = bump(studio, [0.5, 0.25]) | {"tangents": frames}

    seen = seen_normals(studio, surface, (65, 65), mesh=ball)[32, 32]

    np.testing.assert_allclose(seen, unit([0.5, 0.25, 1.0]), atol=2e-2)
    if frames == "sphere":
        np.testing.assert_allclose(seen, unit([0.5, 0.25, 1.0]), atol=1e-5)


def test_the_report_names_the_poles_of_a_globe_with_bumps(studio: Studio) -> None:
    plain = {"mesh": {"type": "sphere"}, "surface": {"technique": "unlit"}}
    bumpy = {**plain, "surface": {"technique": "unlit"} | bump(studio, [0.5, 0.25])}
    nodes = [plain, {**bumpy, "surface": bumpy["surface"] | {"tangents": "sphere"}}]

    studio.draw({"camera": CAMERA, "nodes": nodes})

    (told,) = studio.found["frames"]
    assert (told["object"], told["frames"], told["index_sum"]) == (2, "sphere", 2)
    assert [item["index"] for item in told["singular"]] == [1, 1]
    assert {tuple(item["position"]) for item in told["singular"]} == {(0, 1, 0), (0, -1, 0)}


def test_where_nothing_tilts_along_u_nothing_is_told(studio: Studio) -> None:
    seen_normals(studio, {"height": {"texture": {"technique": "perlin"}}})

    assert studio.found == {}
