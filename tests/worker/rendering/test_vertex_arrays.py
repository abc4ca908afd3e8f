"""What vertices carry arrives at the fragment, whatever else is there or is not."""

import itertools
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from api_schemas import meshes
from api_schemas.coordinates.uv import UvSpec
from tests.worker.rendering.studio import Pixels, Studio
from worker.geometry import primitives
from worker.geometry.mesh import Mesh

pytestmark = pytest.mark.gl

CORNERS = np.array([[-1, -1, 0], [1, -1, 0], [-1, 1, 0], [1, 1, 0]], dtype=np.float64)
UV = (CORNERS[:, :2] + 1) / 2
SQUARE = Mesh(
    positions=CORNERS,
    normals=np.tile([0.0, 0.0, 1.0], (4, 1)),
    uv_sets=(),
    triangles=np.array([[0, 1, 3], [0, 3, 2]], dtype=np.uint32),
)
COLOURS = np.array([[1.0, 0.5, 0.25, 1.0]] * 4)
TANGENTS = np.array([[1.0, 0.0, 0.0, 1.0]] * 4)
WHITE = {"technique": "unlit"}
FRONT = {"type": "directional", "direction": [0.0, 0.0, -1.0]}


def drawn(
    studio: Studio,
    mesh: Mesh,
    surface: dict[str, Any],
    size: tuple[int, int] = (16, 16),
    supersampling: int = 1,
    **scene: Any,
) -> Pixels:
    camera = {"type": "orthographic", "height": 2.0, "pose": {"eye": [0.0, 0.0, 2.0]}}
    node = {"mesh": studio.mesh(mesh), "surface": surface}
    return studio.draw({"camera": camera, "nodes": [node], **scene}, size, supersampling)


def ramp(studio: Studio, uv_set: int) -> dict[str, Any]:
    """Read (u, v) as red and green to float precision: two texels, smooth between."""
    picture = studio.texture([[[0, 1, 0], [1, 1, 0]], [[0, 0, 0], [1, 0, 0]]])
    half = {"scale": [0.5, 0.5], "offset": [0.25, 0.25]}
    coordinates = {"technique": "uv", "set": uv_set}
    mapped = {"texture": picture, "transform": half, "filter": "bilinear"}
    return {"technique": "unlit", "color": {**mapped, "coordinates": coordinates}}


@pytest.mark.parametrize("colours", [None, COLOURS])
@pytest.mark.parametrize("tangents", [None, TANGENTS])
@pytest.mark.parametrize("sets", range(5))
@pytest.mark.parametrize("asked", range(4))
def test_each_uv_set_is_read_and_the_first_stands_in_for_those_missing(
    studio: Studio,
    colours: np.ndarray | None,
    tangents: np.ndarray | None,
    sets: int,
    asked: int,
) -> None:
    turned = [UV, UV[:, ::-1], 1 - UV, UV * [1, 0.5]]
    mesh = replace(SQUARE, uv_sets=tuple(turned[:sets]), colors=colours, tangents=tangents)

    pixels = drawn(studio, mesh, ramp(studio, asked))

    place = (np.arange(16) + 0.5) / 16
    u, v = np.meshgrid(place, place[::-1])
    nothing = (np.zeros_like(u), np.zeros_like(v))
    expected = ((u, v), (v, u), (1 - u, 1 - v), (u, v / 2), nothing)
    red, green = expected[4 if sets == 0 else asked if asked < sets else 0]
    tint = [1.0, 1.0] if colours is None else [1.0, 0.5]
    np.testing.assert_allclose(pixels[..., 0], red * tint[0], atol=1e-6)
    np.testing.assert_allclose(pixels[..., 1], green * tint[1], atol=1e-6)


def test_a_surface_may_ask_for_as_many_sets_as_meshes_hold() -> None:
    from worker.geometry.mesh import UV_SETS_MAX  # noqa: PLC0415

    for index in range(UV_SETS_MAX):
        UvSpec(technique="uv", set=index)
    with pytest.raises(ValueError, match="less than or equal"):
        UvSpec(technique="uv", set=UV_SETS_MAX)


def test_colours_are_interpolated_linearly(studio: Studio) -> None:
    corners = np.array([[0, 0, 0, 1], [1, 0, 0.5, 1], [0, 2, 0, 1], [1, 2, 0.5, 1]], np.float64)

    pixels = drawn(studio, replace(SQUARE, colors=corners), WHITE)

    place = (np.arange(16) + 0.5) / 16
    u, v = np.meshgrid(place, place[::-1])
    expected = np.stack([u, 2 * v, u / 2], axis=2)
    np.testing.assert_allclose(pixels[..., :3], expected, atol=1e-6)


@pytest.mark.parametrize(
    ("surface", "expected"),
    [
        ({"technique": "unlit", "color": [2.0, 2.0, 2.0]}, [2.0, 1.0, 0.5]),
        # ambient 0.5 and one light head-on: Ca La + Cd, with the mesh's colour on both
        ({"technique": "phong", "diffuse_color": [0.5, 0.5, 0.5]}, [0.75, 0.375, 0.1875]),
    ],
)
def test_a_meshs_colour_multiplies_the_surfaces(
    studio: Studio, surface: dict[str, Any], expected: list[float]
) -> None:
    lights = [FRONT, {"type": "ambient", "radiance": [0.5, 0.5, 0.5]}]

    pixels = drawn(studio, replace(SQUARE, colors=COLOURS), surface, lights=lights)

    np.testing.assert_array_equal(pixels[3, 3, :3], np.float32(expected))


def test_a_meshs_colour_does_not_stain_the_next_mesh(studio: Studio) -> None:
    coloured = drawn(studio, replace(SQUARE, colors=COLOURS), WHITE)
    plain = drawn(studio, SQUARE, WHITE)

    assert (plain == 1).all()
    assert not (coloured[..., :3] == 1).all()


@pytest.mark.parametrize("supersampling", [1, 3, 4])
def test_a_line_is_one_pixel_wide(studio: Studio, supersampling: int) -> None:
    # At the middle of the sixth row of pixels from the top, from the third column on.
    y = 1 - 5.5 / 8
    line = Mesh(
        positions=np.array([[-1 + 2 / 8, y, 0], [1, y, 0]]),
        normals=np.zeros((2, 3)),
        uv_sets=(),
        triangles=np.array([[0, 1]], dtype=np.uint32),
        kind="lines",
    )

    covered = drawn(studio, line, WHITE, supersampling=supersampling)[..., 3]

    expected = np.zeros((16, 16))
    expected[5, 2:] = 1
    # OpenGL leaves to the driver which of the samples at a line's two ends it takes.
    np.testing.assert_array_equal(covered[:, 3:-1], expected[:, 3:-1])


@pytest.mark.parametrize("supersampling", [1, 3, 4])
def test_a_point_is_one_pixel(studio: Studio, supersampling: int) -> None:
    columns, rows = np.array([0, 3, 9, 15]), np.array([2, 3, 8, 15])
    positions = np.stack([(columns + 0.5) / 8 - 1, 1 - (rows + 0.5) / 8, 0 * rows], axis=1)
    points = Mesh(
        positions=positions,
        normals=np.zeros((4, 3)),
        uv_sets=(),
        triangles=np.arange(4, dtype=np.uint32)[:, None],
        kind="points",
    )

    covered = drawn(studio, points, WHITE, supersampling=supersampling)[..., 3]

    expected = np.zeros((16, 16))
    expected[rows, columns] = 1
    np.testing.assert_array_equal(covered, expected)


def points_that_face(normal: list[float]) -> Mesh:
    place = (np.arange(16) + 0.5) / 8 - 1
    positions = np.array([[x, y, 0] for x, y in itertools.product(place, place)])
    return Mesh(
        positions=positions,
        normals=np.tile(normal, (256, 1)),
        uv_sets=(),
        triangles=np.arange(256, dtype=np.uint32)[:, None],
        colors=np.tile([1.0, 0.5, 0.25, 1.0], (256, 1)),
        kind="points",
    )


def test_points_with_normals_are_lit_by_them(studio: Studio) -> None:
    surface = {"technique": "phong", "diffuse_color": [1.0, 1.0, 1.0]}

    pixels = drawn(studio, points_that_face([0.6, 0.0, 0.8]), surface, lights=[FRONT])

    np.testing.assert_allclose(pixels[3, 3, :3], [0.8, 0.4, 0.2], rtol=1e-6)


def test_points_without_normals_show_their_colour_and_what_they_emit(studio: Studio) -> None:
    # glTF 2.0, section 3.9.6: base colour, times the mesh's, plus emission, whatever the lights
    surface = {
        "technique": "phong",
        "diffuse_color": [0.5, 0.5, 0.5],
        "emission": [0.25, 0.0, 1.0],
    }

    pixels = drawn(studio, points_that_face([0.0, 0.0, 0.0]), surface, lights=[FRONT])

    np.testing.assert_array_equal(pixels[..., :3], np.full((16, 16, 3), [0.75, 0.25, 1.125]))


def test_a_mesh_is_counted_as_what_is_held_of_it(studio: Studio) -> None:
    from worker.rendering.vertex_arrays import VertexArray  # noqa: PLC0415  needs OpenGL

    studio.poster({"technique": "unlit"})  # opens the context
    ball = primitives.build(meshes.Sphere(type="sphere", segments=40, rings=20))

    uploaded = VertexArray.upload(ball)

    # In float32: position, normal and uv in OpenGL, positions here; triangles in both.
    vertices, triangles = len(ball.positions), len(ball.triangles)
    assert uploaded.size_bytes == vertices * 4 * (3 + 3 + 2 + 3) + 2 * triangles * 12
    uploaded.delete()
