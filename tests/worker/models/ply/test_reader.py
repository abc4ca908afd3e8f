import hashlib
import struct
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from api_schemas.maps import ColorMap
from api_schemas.surfaces.phong import PhongSpec
from tests.worker.models.refusals import outcome
from worker.errors import UnusableAssetError
from worker.geometry.mesh import Mesh
from worker.models.formats import read_model

XYZ = [("float", "x"), ("float", "y"), ("float", "z")]
SQUARE = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)]
FACES = [("list uchar int", "vertex_indices")]
FORMATS = ("ascii", "binary_little_endian", "binary_big_endian")
CODES = {
    "char": "b",
    "uchar": "B",
    "short": "h",
    "ushort": "H",
    "int": "i",
    "uint": "I",
    "float": "f",
    "double": "d",
    "uint8": "B",
    "float32": "f",
}


def ply(
    form: str, *elements: tuple[str, list[tuple[str, str]], list[tuple]], comment: str = ""
) -> bytes:
    """Write elements: name, properties and rows; a list is a tuple within its row."""
    header = [f"ply\nformat {form} 1.0\n{comment}"]
    body = b""
    order = ">" if form == "binary_big_endian" else "<"
    for name, properties, rows in elements:
        header.append(f"element {name} {len(rows)}\n")
        header += [f"property {kind} {label}\n" for kind, label in properties]
        for row in rows:
            for (kind, _), value in zip(properties, row, strict=True):
                *_, count, item = ["", "", *kind.split()]
                numbers = value if isinstance(value, tuple) else (value,)
                if form == "ascii":
                    written = [len(value)] if isinstance(value, tuple) else []
                    body += " ".join(map(str, [*written, *numbers])).encode() + b" "
                else:
                    if isinstance(value, tuple):
                        body += struct.pack(order + CODES[count], len(value))
                    body += struct.pack(f"{order}{len(numbers)}{CODES[item]}", *numbers)
            body += b"\n" if form == "ascii" else b""
    return "".join([*header, "end_header\n"]).encode() + body


def square(form: str = "ascii", faces: list[tuple] | None = None) -> bytes:
    rows = [((0, 1, 2, 3),)] if faces is None else faces
    return ply(form, ("vertex", XYZ, SQUARE), ("face", FACES, rows))


def mesh(data: bytes) -> Mesh:
    (part,) = read_model(data, {}).parts
    return part.mesh


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


HEAD = b"ply\nformat ascii 1.0\nelement vertex 3\n"


@pytest.mark.parametrize(
    ("data", "complaint"),
    [
        (b"ply\n", "its header has no end"),
        (b"ply\nend_header\n", "does not say the format"),
        (b"ply\nformat ascii 1.0\nend_header\n", "no vertices"),
        (b"ply\nformat ebcdic 1.0\nend_header\n", "line 2 of its header"),
        (b"ply\nproperty float x\nend_header\n", "line 2 of its header"),
        (HEAD + b"property half x\nend_header\n", "no known type"),
        (HEAD + b"property list float int x\nend_header\n", "no known type"),
        (HEAD + b"property float x\nend_header\n1 2 3", "no x, y and z"),
        (HEAD.replace(b"3", b"-3") + b"end_header\n", "line 3 of its header"),
        (HEAD.replace(b"3", b"0") + b"property int x\nend_header\n", "no vertices"),
        (square()[:-20], "fewer numbers than|longer than"),
        (square("binary_little_endian")[:-1], "longer than what is there"),
        (square("binary_big_endian")[:-20], "fewer numbers than"),
        (square(faces=[((0, 1, 4),)]), "names none of its 4 vertices"),
        (square(faces=[((0, 1, -1),)]), "names none of its 4 vertices"),
        (square().replace(b"0 1 2 3 \n", b"0 1 2 x \n"), "names none of its 4 vertices"),
        (square().replace(b"1 0 0", b"1 nan 0"), "not three numbers"),
        (square().replace(b"1 0 0", b"1 2e9 0"), "not three numbers"),
    ],
)
def test_what_cannot_be_meant_is_refused(data: bytes, complaint: str) -> None:
    with pytest.raises(UnusableAssetError, match=complaint) as refusal:
        read_model(data, {})
    assert refusal.value.code == "asset_unusable"


@pytest.mark.parametrize("form", FORMATS)
def test_a_hundred_thousand_million_vertices_are_refused_before_any_is_read(form: str) -> None:
    data = square(form).replace(b"element vertex 4", b"element vertex 99999999999")

    with pytest.raises(UnusableAssetError, match="99999999999 rows") as refusal:
        read_model(data, {})
    assert refusal.value.code == "asset_too_large"


@pytest.mark.parametrize("form", FORMATS)
def test_a_list_of_four_thousand_million_items_is_refused(form: str) -> None:
    data = ply(form, ("vertex", XYZ, SQUARE), ("face", [("list uint int", "vertex_indices")], []))
    data = data.replace(b"element face 0", b"element face 1")
    data += b"4294967295 " if form == "ascii" else b"\xff\xff\xff\xff"

    with pytest.raises(UnusableAssetError, match="longer than what is there"):
        read_model(data, {})


@given(st.sampled_from(FORMATS), st.binary(max_size=3), st.integers(0, 330), st.integers(0, 30))
def test_damage_is_read_or_refused_by_name(form: str, noise: bytes, at: int, cut: int) -> None:
    layout = [*FACES, ("list uchar float", "texcoord"), ("uchar", "red")]
    whole = ply(
        form, ("vertex", XYZ, SQUARE), ("face", layout, [((0, 1, 2), (0, 0, 1, 0, 1, 1), 9)])
    )
    damaged = whole[:at] + noise + whole[at + cut :]

    named = ("read", "asset_unusable", "asset_unsupported", "asset_too_large")
    assert outcome(damaged, {}) in named


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
