"""Normal maps against the tilt worked out by hand (T11)."""

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from tests.worker.rendering.studio import Pixels, Studio
from tests.worker.rendering.test_vertex_arrays import SQUARE, UV, points_that_face
from worker.geometry.mesh import Mesh

pytestmark = pytest.mark.gl

AXES = np.eye(3)
COLOURS = {"red": [1.0, 0.0, 0.0], "green": [0.0, 1.0, 0.0], "blue": [0.0, 0.0, 1.0]}
TILT = np.array([0.6, -0.35, 0.72])
CHARTED = replace(SQUARE, uv_sets=(UV,))
TOLERANCE = 1e-5


def lights(side: float) -> list[dict[str, Any]]:
    """One light of a colour of its own along each axis."""
    return [
        {"type": "directional", "direction": list(-side * axis), "color": colour}
        for axis, colour in zip(AXES, COLOURS.values(), strict=True)
    ]


def normals(
    studio: Studio,
    node: dict[str, Any],
    normal: dict[str, Any] | None,
    eye: tuple[float, float, float] = (0.0, 0.0, 2.0),
    size: tuple[int, int] = (8, 8),
) -> Pixels:
    """See the normal at every pixel: on white chalk each light shows one coordinate, n.l."""
    surface = {"technique": "phong", "diffuse_color": [1.0, 1.0, 1.0], "normal": normal}
    camera = {"type": "orthographic", "height": 2.0, "pose": {"eye": list(eye)}}
    one, other = (
        studio.draw(
            {"camera": camera, "lights": lights(side), "nodes": [{**node, "surface": surface}]},
            size,
        )
        for side in (1.0, -1.0)
    )
    return (one - other)[..., :3]


def unit(vector: Any) -> np.ndarray:
    return np.asarray(vector) / np.linalg.norm(vector)


def constant(studio: Studio, value: Any, **how: Any) -> dict[str, Any]:
    return {"texture": studio.texture(np.float32([[value]])), **how}


def coded(vector: Any) -> np.ndarray:
    """What a picture of range "unit" holds for a vector."""
    return (np.asarray(vector) + 1) / 2


@pytest.mark.parametrize("technique", ["phong", "metallic_roughness"])
def test_a_flat_map_is_no_map(studio: Studio, technique: str) -> None:
    surface: dict[str, Any] = {"technique": technique}
    if technique == "phong":
        surface |= {"specular_weight": 1.0, "exponent": 20.0}
    flat = {**surface, "normal": constant(studio, coded([0, 0, 1]))}

    def ball(surface: dict[str, Any]) -> Pixels:
        return studio.draw(
            {
                "camera": {"type": "perspective", "pose": {"eye": [1.0, 2.0, 3.0]}},
                "lights": [{"type": "directional", "direction": [-1.0, -0.5, -0.3]}],
                "nodes": [{"mesh": {"type": "sphere"}, "surface": surface}],
            }
        )

    np.testing.assert_allclose(ball(flat), ball(surface), rtol=1e-5, atol=1e-6)


@pytest.mark.parametrize("length", [1.0, 0.5, 3.0])
@pytest.mark.parametrize("kind", ["unit", "signed"])
@pytest.mark.parametrize("green", ["up", "down"])
@pytest.mark.parametrize("strength", [0.0, 0.25, 1.0, 3.0, -1.0])
def test_the_tilt_is_what_the_map_says(
    studio: Studio, strength: float, green: str, kind: str, length: float
) -> None:
    held = length * TILT if kind == "signed" else coded(length * TILT)
    how = {"strength": strength, "green": green, "range": kind}

    seen = normals(studio, {"mesh": {"type": "plane"}}, constant(studio, held, **how))

    x, y, z = unit(TILT)
    expected = unit([strength * x, strength * y * (1 if green == "up" else -1), z])
    np.testing.assert_allclose(seen[4, 4], expected, atol=TOLERANCE)


@pytest.mark.parametrize(
    ("right", "up"),
    [
        ([0, 0, -1], [0, 1, 0]),
        ([0, 0, 1], [0, 1, 0]),
        ([1, 0, 0], [0, 0, -1]),
        ([1, 0, 0], [0, 1, 0]),
    ],
    ids=["+x", "-x", "+y", "+z"],
)
def test_tangent_and_bitangent_point_where_u_and_v_grow(
    studio: Studio, right: list[float], up: list[float]
) -> None:
    # Text reads upright on a box's sides, and on its lid for who looks down with the front below.
    out = np.cross(right, up)
    held = constant(studio, TILT, range="signed")

    seen = normals(studio, {"mesh": {"type": "box"}}, held, tuple(2.0 * out + [0, 0, 1e-3]))

    expected = unit(TILT @ np.array([right, up, out], dtype=np.float64))
    np.testing.assert_allclose(seen[4, 4], expected, atol=TOLERANCE)


def test_seen_from_inside_a_bump_is_a_dent(studio: Studio) -> None:
    held = constant(studio, TILT, range="signed")

    seen = normals(studio, {"mesh": {"type": "plane"}}, held, (0.0, 0.0, -2.0))

    np.testing.assert_allclose(seen[4, 4], -unit(TILT), atol=TOLERANCE)


@pytest.mark.parametrize("mirrored", ["u", "v", "both"])
def test_in_a_mirrored_chart_the_tilt_is_mirrored(studio: Studio, mirrored: str) -> None:
    signs = {"u": [-1, 1], "v": [1, -1], "both": [-1, -1]}[mirrored]
    flipped = np.where(np.array(signs) < 0, 1 - UV, UV)

    seen = normals(
        studio,
        {"mesh": studio.mesh(replace(SQUARE, uv_sets=(flipped,)))},
        constant(studio, TILT, range="signed"),
    )

    np.testing.assert_allclose(seen[4, 4], unit(TILT * [*signs, 1]), atol=TOLERANCE)


def test_charts_that_mirror_each_other_meet_in_a_sharp_line(studio: Studio) -> None:
    # Left half u = 1 + x, right half u = 1 - x: vertices in the middle are shared.
    positions = np.array([[x, y, 0] for y in (-1, 1) for x in (-1, 0, 1)], dtype=np.float64)
    mesh = Mesh(
        positions=positions,
        normals=np.tile([0.0, 0.0, 1.0], (6, 1)),
        uv_sets=(np.stack([1 - np.abs(positions[:, 0]), (positions[:, 1] + 1) / 2], axis=1),),
        triangles=np.array([[0, 1, 4], [0, 4, 3], [1, 2, 5], [1, 5, 4]], dtype=np.uint32),
    )

    seen = normals(studio, {"mesh": studio.mesh(mesh)}, constant(studio, TILT, range="signed"))

    x, y, z = unit(TILT)
    np.testing.assert_allclose(seen[:, :4], np.broadcast_to([x, y, z], (8, 4, 3)), atol=TOLERANCE)
    np.testing.assert_allclose(seen[:, 4:], np.broadcast_to([-x, y, z], (8, 4, 3)), atol=TOLERANCE)


@pytest.mark.parametrize("scale", [[2.0, 2.0, 2.0], [-1.0, 1.0, 1.0], [1.0, -2.0, 1.0]], ids=str)
def test_a_node_that_stretches_or_mirrors_takes_its_bumps_along(
    studio: Studio, scale: list[float]
) -> None:
    seen = normals(
        studio,
        {"mesh": {"type": "plane"}, "transform": {"scale": scale}},
        constant(studio, TILT, range="signed"),
    )

    np.testing.assert_allclose(seen[4, 4], unit(TILT * np.sign(scale)), atol=TOLERANCE)


@pytest.mark.parametrize("turn", [0.0, np.pi / 2, 1.0])
@pytest.mark.parametrize("scale", [[1.0, 1.0], [3.0, 3.0], [-1.0, 1.0], [1.0, -2.0]], ids=str)
def test_a_picture_that_lies_turned_has_its_bumps_turned(
    studio: Studio, turn: float, scale: list[float]
) -> None:
    # A slope along the picture's own x: its unit vector there, in uv, is row 0 of the transform.
    transform = {"rotation": turn, "scale": scale}

    seen = normals(
        studio,
        {"mesh": {"type": "plane"}},
        constant(studio, [0.6, 0.0, 0.8], range="signed", transform=transform),
    )

    along = np.array([np.cos(turn), -np.sin(turn)]) * np.sign(scale)
    np.testing.assert_allclose(seen[4, 4], [*(0.6 * along), 0.8], atol=TOLERANCE)


def test_the_tangents_of_a_file_are_taken_as_they_are(studio: Studio) -> None:
    # u grows to the right, but this file says: up and a little forward, with a mirrored bitangent.
    tangent = unit([0.1, 1.0, 0.2])
    mesh = replace(CHARTED, tangents=np.tile([*tangent, -1.0], (4, 1)))

    seen = normals(studio, {"mesh": studio.mesh(mesh)}, constant(studio, TILT, range="signed"))

    bitangent = -np.cross([0, 0, 1], tangent)
    expected = unit(TILT @ np.array([tangent, bitangent, [0, 0, 1]]))
    np.testing.assert_allclose(seen[4, 4], expected, atol=TOLERANCE)


def test_tangents_follow_the_uv_set_of_the_map(studio: Studio) -> None:
    mesh = replace(SQUARE, uv_sets=(UV, UV[:, ::-1]))
    held = constant(studio, TILT, range="signed", coordinates={"technique": "uv", "set": 1})

    seen = normals(studio, {"mesh": studio.mesh(mesh)}, held)

    x, y, z = unit(TILT)
    np.testing.assert_allclose(seen[4, 4], [y, x, z], atol=TOLERANCE)


def test_without_coordinates_a_flat_map_is_still_flat(studio: Studio) -> None:
    seen = normals(studio, {"mesh": studio.mesh(SQUARE)}, constant(studio, coded([0, 0, 1])))

    np.testing.assert_allclose(seen, np.broadcast_to([0, 0, 1], (8, 8, 3)), atol=TOLERANCE)


@pytest.mark.parametrize(
    "held", [[0.0, 0.0, 0.0], [np.nan, 0.0, 1.0], [0.0, np.inf, 1.0], [1.0, 1.0, -np.inf]]
)
def test_where_a_map_has_no_direction_the_surface_keeps_its_own(studio: Studio, held: Any) -> None:
    seen = normals(studio, {"mesh": {"type": "plane"}}, constant(studio, held, range="signed"))

    np.testing.assert_allclose(seen[4, 4], [0, 0, 1], atol=TOLERANCE)


@pytest.mark.parametrize("factor", [1e-30, 1e30])
def test_only_the_direction_counts(studio: Studio, factor: float) -> None:
    held = constant(studio, factor * TILT, range="signed")

    seen = normals(studio, {"mesh": {"type": "plane"}}, held)

    np.testing.assert_allclose(seen[4, 4], unit(TILT), atol=TOLERANCE)


def test_the_steepest_tilt_is_a_right_angle(studio: Studio) -> None:
    held = constant(studio, [0.6, 0.0, 0.8], range="signed", strength=1e30)

    seen = normals(studio, {"mesh": {"type": "plane"}}, held)

    np.testing.assert_allclose(seen[4, 4], [1, 0, 0], atol=TOLERANCE)


def test_points_take_no_notice_of_a_normal_map(studio: Studio) -> None:
    # glTF 2.0, section 3.9.6: without tangents, normal textures are ignored
    mesh = replace(points_that_face([0.6, 0.0, 0.8]), colors=None)

    seen = normals(
        studio, {"mesh": studio.mesh(mesh)}, constant(studio, TILT, range="signed"), size=(16, 16)
    )

    np.testing.assert_allclose(seen[4, 4], [0.6, 0.0, 0.8], atol=TOLERANCE)


def test_points_without_normals_show_their_colour_under_a_normal_map(studio: Studio) -> None:
    # glTF 2.0, section 3.7.2.1: points and lines without normals are not lit
    surface = {"technique": "phong", "normal": constant(studio, TILT, range="signed")}
    node = {"mesh": studio.mesh(points_that_face([0.0, 0.0, 0.0])), "surface": surface}
    camera = {"type": "orthographic", "height": 2.0, "pose": {"eye": [0.0, 0.0, 2.0]}}

    drawn = studio.draw({"camera": camera, "lights": lights(1.0), "nodes": [node]}, (16, 16))

    np.testing.assert_allclose(drawn[4, 4, :3], 0.8 * np.array([1.0, 0.5, 0.25]), rtol=1e-6)


def test_on_a_ball_the_axes_are_those_of_longitude_and_latitude(studio: Studio) -> None:
    side = 32
    node = {"mesh": {"type": "sphere", "segments": 512, "rings": 256}}

    seen = normals(studio, node, constant(studio, TILT, range="signed"), size=(side, side))

    place = (np.arange(side) + 0.5) / side * 2 - 1
    x, y = np.meshgrid(place, place[::-1])
    inside = x**2 + y**2 < 0.5
    z = np.sqrt(np.where(inside, 1 - x**2 - y**2, 1))
    out = np.stack([x, y, z], axis=2)
    east = np.stack([z, 0 * x, -x], axis=2) / np.hypot(x, z)[..., None]
    expected = TILT[0] * east + TILT[1] * np.cross(out, east) + TILT[2] * out
    expected /= np.linalg.norm(TILT)
    # Facets of 2 pi / 512 shift what is seen by some 4e-5 and lay its tangents between corners.
    np.testing.assert_allclose(seen[inside], expected[inside], atol=2e-4)
