import hashlib
from pathlib import Path

import numpy as np
import pytest

from api_schemas.maps import ColorMap
from api_schemas.surfaces.phong import PhongSpec
from tests.worker.models.ply.building import FACES, FORMATS, SQUARE, XYZ, mesh, ply, square
from worker.models.formats import read_model


@pytest.mark.parametrize("form", FORMATS)
def test_faces_of_any_size_become_triangles_with_smooth_normals(form: str) -> None:
    found = mesh(square(form, [((0, 1, 2),), ((0, 2, 3),), ((0, 1, 2, 3),)]))

    assert found.positions.tolist() == [list(corner) for corner in SQUARE]
    assert found.triangles.tolist() == [[0, 1, 2], [0, 2, 3], [0, 1, 2], [0, 2, 3]]
    assert found.normals.tolist() == [[0, 0, 1]] * 4
    assert found.uv_sets == ()
    assert found.colors is None


@pytest.mark.parametrize("form", FORMATS)
def test_every_kind_of_number_is_read_and_what_is_unknown_is_stepped_over(form: str) -> None:
    properties = [
        *[("char", "a"), ("double", "x"), ("list ushort double", "more"), ("short", "y")],
        *[("uint", "b"), ("float32", "z"), ("list uint8 short", "rest")],
    ]
    rows = [(-1, x, (0.5, 2.5), y, 2**32 - 1, z, ()) for x, y, z in SQUARE]
    faces = [((7, 7, 7), (0, 1, 2), 3.5)]
    layout = [("list uint ushort", "x"), ("list int uint", "vertex_index"), ("double", "w")]
    data = ply(
        form,
        ("camera", [("list uchar float", "x")], [((1.0, 2.0),), ((),)]),
        ("vertex", properties, rows),
        ("face", layout, faces),
    )

    assert mesh(data).positions.tolist() == [list(corner) for corner in SQUARE[:3]]


@pytest.mark.parametrize("names", [("s", "t"), ("u", "v"), ("texture_u", "texture_v")])
@pytest.mark.parametrize("form", FORMATS)
def test_texture_coordinates_have_v_up(form: str, names: tuple[str, str]) -> None:
    properties = [*XYZ, *(("float", name) for name in names)]
    rows = [(*corner, corner[0] / 4, corner[1] / 2) for corner in SQUARE]
    found = mesh(ply(form, ("vertex", properties, rows), ("face", FACES, [((0, 1, 2, 3),)])))

    assert found.uv(0).tolist() == [[0, 0], [0.25, 0], [0.25, 0.5], [0, 0.5]]


@pytest.mark.parametrize("form", FORMATS)
def test_texture_coordinates_of_corners_part_the_vertices(form: str) -> None:
    layout = [*FACES, ("list uchar float", "texcoord")]
    faces = [((0, 1, 2), (0, 0, 1, 0, 1, 1)), ((0, 2, 3), (0.5, 0, 1, 1, 0, 1))]
    found = mesh(ply(form, ("vertex", XYZ, SQUARE), ("face", layout, faces)))

    corners = found.triangles.ravel()
    assert found.uv(0)[corners].tolist() == [[0, 0], [1, 0], [1, 1], [0.5, 0], [1, 1], [0, 1]]
    assert len(found.positions) == 5  # vertex 0 has two coordinates, vertex 2 one


@pytest.mark.parametrize("form", FORMATS)
def test_colours_in_whole_numbers_are_srgb_and_in_floats_linear(form: str) -> None:
    names = ("red", "green", "blue", "alpha")
    light = 0.2158605  # IEC 61966-2-1: ((128 / 255 + 0.055) / 1.055) ** 2.4

    def colours(kind: str, colour: tuple) -> list[float]:
        properties = [*XYZ, *((kind, name) for name in names)]
        rows = [(*corner, *colour) for corner in SQUARE]
        found = mesh(ply(form, ("vertex", properties, rows), ("face", FACES, [((0, 1, 2),)])))
        assert found.colors is not None
        return found.colors[0].tolist()  # type: ignore[no-any-return]

    assert colours("uchar", (0, 128, 255, 51)) == pytest.approx([0, light, 1, 0.2], abs=1e-6)
    assert colours("ushort", (0, 128 * 257, 65535, 65535)) == pytest.approx([0, light, 1, 1], 1e-6)
    assert colours("float", (0, 0.5, 4, 0.25)) == [0, 0.5, 4, 0.25]
    assert colours("float", (-1, 0.5, 1, 7)) == [0, 0.5, 1, 1]


def test_colours_of_faces_part_the_vertices() -> None:
    layout = [*FACES, ("uchar", "red"), ("uchar", "green"), ("uchar", "blue")]
    faces = [((0, 1, 2), 255, 0, 0), ((0, 2, 3), 0, 0, 255)]
    found = mesh(ply("ascii", ("vertex", XYZ, SQUARE), ("face", layout, faces)))

    assert found.colors is not None
    assert found.colors[found.triangles].tolist() == [[[1, 0, 0, 1]] * 3, [[0, 0, 1, 1]] * 3]


def test_normals_of_the_file_are_scaled_and_zeros_are_computed() -> None:
    properties = [*XYZ, ("float", "nx"), ("float", "ny"), ("float", "nz")]
    rows = [(*corner, 3, 0, 4) for corner in SQUARE[:3]] + [(*SQUARE[3], 0, 0, 0)]
    faces = [((0, 3, 2, 1),)]
    found = mesh(ply("ascii", ("vertex", properties, rows), ("face", FACES, faces)))
    order = [found.positions.tolist().index(list(corner)) for corner in SQUARE]

    np.testing.assert_allclose(found.normals[order], [[0.6, 0, 0.8]] * 3 + [[0, 0, -1]])


@pytest.mark.parametrize("form", FORMATS)
def test_strips_are_parted_by_minus_one_and_every_second_triangle_is_turned(form: str) -> None:
    strips = [((0, 1, 3, 2, 2, -1, 0, 1, 2),), ((1, 2),), ((3, 0, 1),)]
    layout = [("list int int", "vertex_indices")]
    found = mesh(ply(form, ("vertex", XYZ, SQUARE), ("tristrips", layout, strips)))

    triangles = found.positions[found.triangles].tolist()
    expected = [(0, 1, 3), (3, 1, 2), (0, 1, 2), (3, 0, 1)]
    assert triangles == [[list(SQUARE[i]) for i in row] for row in expected]


def test_edges_are_lines_and_vertices_alone_are_points() -> None:
    edges = [("int", "vertex1"), ("int", "vertex2")]
    lines = mesh(ply("ascii", ("vertex", XYZ, SQUARE), ("edge", edges, [(0, 1), (2, 0)])))
    points = mesh(ply("ascii", ("vertex", XYZ, SQUARE), ("face", FACES, [])))

    assert lines.kind == "lines"
    assert lines.positions[lines.triangles].tolist() == [
        [[0, 0, 0], [1, 0, 0]],
        [[1, 1, 0], [0, 0, 0]],
    ]
    assert points.kind == "points"
    assert points.positions[points.triangles[:, 0]].tolist() == [list(c) for c in SQUARE]


def test_rows_that_are_lines_may_hold_more_than_was_announced() -> None:
    """MeshLab announced colours of faces as four numbers and wrote them as a list."""
    data = square().replace(b"0 1 2 3 \n", b"0 1 2 3 9 9 9\n").replace(b"1 0 0", b"1 0 0 7")

    assert mesh(data).positions.tolist() == [list(corner) for corner in SQUARE]


def test_rows_need_not_be_lines() -> None:
    head, body = square().split(b"end_header\n")

    assert len(mesh(head + b"end_header\n" + body.replace(b"\n", b" ")).triangles) == 2


@pytest.mark.parametrize("line_end", [b"\n", b"\r\n", b"\r"])
def test_a_header_may_have_any_line_end(line_end: bytes) -> None:
    for form in FORMATS:
        head, body = square(form).split(b"end_header\n")
        head = (head + b"end_header\n").replace(b"\n", line_end)
        assert len(mesh(head + body).triangles) == 2


def test_the_picture_of_a_comment_is_worn_if_it_is_there() -> None:
    properties = [*XYZ, ("float", "s"), ("float", "t")]
    rows = [(*corner, 0, 1) for corner in SQUARE]
    data = ply(
        "ascii",
        ("vertex", properties, rows),
        ("face", FACES, [((0, 1, 2),)]),
        comment="comment TextureFile my wood.png\n",
    )
    picture = b"\x89PNG\r\n\x1a\n and so on"
    model = read_model(data, {"my wood.png": picture})

    sha256 = hashlib.sha256(picture).hexdigest()
    surface = model.surfaces[0].surface
    assert isinstance(surface, PhongSpec)
    assert isinstance(surface.diffuse_color, ColorMap)
    assert surface.diffuse_color.texture.asset == sha256  # type: ignore[attr-defined]
    assert dict(model.pictures) == {sha256: picture}
    assert model.parts[0].material == 0
    alone = read_model(data, {})
    assert alone.parts[0].material is None
    assert alone.warnings == ("its comment names a picture that is not in its set",)


@pytest.mark.corpus
def test_a_model_in_text_and_in_binary_is_one_model(corpus: Path) -> None:
    """MeshLab wrote both of one mesh, with texture coordinates of corners and colours."""
    folder = corpus / "1_models" / "trimesh"
    text, packed = (mesh((folder / name).read_bytes()) for name in ("fuze_ascii.ply", "fuze.ply"))

    np.testing.assert_array_equal(text.triangles, packed.triangles)
    np.testing.assert_allclose(text.positions, packed.positions, atol=1e-6)
    np.testing.assert_allclose(text.uv(0), packed.uv(0), atol=1e-6)
    assert text.colors is not None
    np.testing.assert_array_equal(text.colors, packed.colors)
