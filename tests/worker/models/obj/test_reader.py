from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from api_schemas.surfaces.phong import PhongSpec
from tests.worker.models.refusals import outcome
from worker.errors import AssetMissingError, UnusableAssetError
from worker.geometry.mesh import Mesh
from worker.models.formats import read_model
from worker.models.obj import reader as obj

TRIANGLE = "v 0 0 0\nv 1 0 0\nv 0 1 0\n"
# Two faces of a roof: the ridge is the edge of vertices 1 and 2, the slopes are 45 degrees.
ROOF = "v 0 1 0\nv 0 1 2\nv -1 0 0\nv -1 0 2\nv 1 0 0\nv 1 0 2\n"
SLOPES = "f 1 3 4 2\nf 1 2 6 5\n"
HALF = 0.5**0.5


def mesh(text: str) -> Mesh:
    (part,) = read_model(text.encode(), {}).parts
    return part.mesh


def normal_at(found: Mesh, position: tuple[float, ...]) -> list[list[float]]:
    at = (found.positions == position).all(axis=1)
    return sorted(found.normals[at].round(12).tolist())


def test_corners_share_vertices_where_everything_is_equal() -> None:
    found = mesh(
        f"{TRIANGLE}v 1 1 0\nvt 0 0\nvt 1 0.25\nvn 0 0 2\nf 1/1/1 2/2/1 3/1/1\nf 2/2/1 4/1/1 3/2/1"
    )

    assert found.triangles.tolist() == [[0, 1, 2], [1, 3, 4]]
    assert found.positions.tolist() == [[0, 0, 0], [1, 0, 0], [0, 1, 0], [1, 1, 0], [0, 1, 0]]
    assert found.uv(0).tolist() == [[0, 0], [1, 0.25], [0, 0], [0, 0], [1, 0.25]]
    assert found.normals.tolist() == [[0, 0, 1]] * 5


@pytest.mark.parametrize(
    "face",
    [
        "f 1 2 3",
        "f -3 -2 -1",
        "f 1/ 2/ 3/",
        "f 1// 2// 3//",
        "f 1/9/9 2/9/9 3/9/9",
        "f 1/0/0 2/0/0 3/0/0",
        "fo 1 2 3",
        "\t f\t1  2\t3  # a comment",
        "f 1 2 \\\n  3",
        "f 1 2 \\\r\n  3",
        "usemtl\nf 1 2 3",
        "vt 1 1\nf 1/1 2 3",
    ],
)
@pytest.mark.parametrize("line_end", ["\n", "\r\n", "\r"])
def test_a_face_may_be_written_in_many_ways(face: str, line_end: str) -> None:
    found = mesh((TRIANGLE + face).replace("\r\n", "\n").replace("\n", line_end))

    assert found.positions.tolist() == [[0, 0, 0], [1, 0, 0], [0, 1, 0]]
    assert found.triangles.tolist() == [[0, 1, 2]]


def test_negative_numbers_count_back_from_where_they_stand() -> None:
    found = mesh("v 9 9 9\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf -3 -2 -1\nv 5 5 5\n")

    assert found.positions.tolist() == [[0, 0, 0], [1, 0, 0], [0, 1, 0]]


def test_texture_coordinates_have_v_up_and_lack_one_where_it_is_not_given() -> None:
    found = mesh(f"{TRIANGLE}vt 0.5\nvt 0.25 0.75 9\nf 1/1 2/2 3")

    assert found.uv(0).tolist() == [[0.5, 0], [0.25, 0.75], [0, 0]]


def test_without_smoothing_groups_faces_that_share_a_vertex_are_smooth() -> None:
    found = mesh(ROOF + SLOPES)

    assert normal_at(found, (0, 1, 0)) == [[0, 1, 0]]
    assert normal_at(found, (1, 0, 0)) == [[round(HALF, 12), round(HALF, 12), 0]]


@pytest.mark.parametrize("smoothing", ["s off\n{}{}", "s 0\n{}{}", "s 1\n{}s 2\n{}"])
def test_without_a_common_smoothing_group_an_edge_is_hard(smoothing: str) -> None:
    left, right = SLOPES.splitlines(keepends=True)
    found = mesh(ROOF + smoothing.format(left, right))

    hard = [[-HALF, HALF, 0], [HALF, HALF, 0]]
    np.testing.assert_allclose(normal_at(found, (0, 1, 0)), hard, atol=1e-12)


def test_normals_of_the_file_come_first_and_those_without_direction_are_computed() -> None:
    found = mesh(f"{TRIANGLE}vn 3 0 4\nvn 0 0 0\nvn x 1 1\nf 1//1 2//2 3//3")

    np.testing.assert_allclose(found.normals, [[0.6, 0, 0.8], [0, 0, 1], [0, 0, 1]], atol=1e-15)


def test_colours_after_vertices_are_srgb_and_the_others_are_white() -> None:
    found = mesh("v 0 0 0 0.5 0 1\nv 1 0 0 1\nv 0 1 0\nf 1 2 3")

    assert found.colors is not None
    # IEC 61966-2-1: ((0.5 + 0.055) / 1.055) ** 2.4
    np.testing.assert_allclose(found.colors, [[0.2140411, 0, 1, 1], [1] * 4, [1] * 4], atol=1e-7)


def test_groups_are_nodes_and_their_materials_are_parts() -> None:
    text = (
        f"{TRIANGLE}o body\nusemtl red\nf 1 2 3\nusemtl blue\nf 1 3 2\n"
        "g left arm\nf 1 2 3\nusemtl red\nf 1 3 2\no body\nf 2 1 3\nusemtl never used\n"
    )
    model = read_model(text.encode(), {})

    assert model.node_names == ("body", "left arm")
    assert [surface.name for surface in model.surfaces] == ["red", "blue"]
    owners = [(part.node, part.material, len(part.mesh.triangles)) for part in model.parts]
    assert owners == [(0, 0, 2), (0, 1, 1), (1, 1, 1), (1, 0, 1)]
    assert len({part.key for part in model.parts}) == 4
    assert all((part.matrix == np.eye(4)).all() for part in model.parts)


def test_without_a_material_there_is_none() -> None:
    (part,) = read_model((TRIANGLE + "f 1 2 3").encode(), {}).parts

    assert part.material is None
    assert part.node is None


def test_lines_and_points_are_parts_of_their_own() -> None:
    model = read_model((TRIANGLE + "l 1 2 3\np 2 3\nf 1 2 3").encode(), {})

    kinds = {part.mesh.kind: part.mesh for part in model.parts}
    assert kinds["lines"].positions[kinds["lines"].triangles].tolist() == [
        [[0, 0, 0], [1, 0, 0]],
        [[1, 0, 0], [0, 1, 0]],
    ]
    assert kinds["points"].positions[kinds["points"].triangles].tolist() == [
        [[1, 0, 0]],
        [[0, 1, 0]],
    ]
    assert not kinds["lines"].normals.any()


def test_more_groups_than_can_be_drawn_are_joined_with_a_warning() -> None:
    faces = "".join(f"g {i}\nf 1 2 3\n" for i in range(obj.GROUPS_MAX + 1))
    model = read_model((TRIANGLE + faces).encode(), {})

    assert len(model.parts) == 1
    assert model.node_names == ()
    assert "groups are joined" in model.warnings[0]


def test_faces_of_two_corners_and_free_forms_are_left_out_with_a_warning() -> None:
    model = read_model((TRIANGLE + "f 1 2\nl 1\nf 1 2 3\nsurf 0 1 0 1 1 2").encode(), {})

    assert len(model.parts[0].mesh.triangles) == 1
    assert "free-form" in model.warnings[0]
    assert model.warnings[1].startswith("2 faces and lines of too few corners")


@pytest.mark.parametrize(
    ("text", "complaint"),
    [
        (f"{TRIANGLE}f 1 2 4", "line 4: a corner names what is not there"),
        (f"{TRIANGLE}f 1 2 0", "line 4: a corner names what is not there"),
        (f"{TRIANGLE}f 1 2 -4", "line 4: a corner names what is not there"),
        (f"{TRIANGLE}f 1 2 99999999999999999999", "line 4: a corner names what is not there"),
        (f"{TRIANGLE}\n# x\nf 1 2 b", "line 6: a corner is not of the form"),
        (f"{TRIANGLE}f 1 2 3/1/1/1", "line 4: a corner is not of the form"),
        (f"{TRIANGLE}f 1 2 3.5", "line 4: a corner is not of the form"),
        (f"{TRIANGLE}f 1 2", "no faces of three corners"),
        (TRIANGLE.replace("1", "nan") + "f 1 2 3", "not three numbers"),
        (TRIANGLE.replace("1", "1e10") + "f 1 2 3", "not three numbers"),
        ("v 0 0\nv 1 0\nv 0 1\nf 1 2 3", "not three numbers"),
        (f"{TRIANGLE}vt x 1\nf 1/1 2/1 3/1", "not two numbers"),
    ],
)
def test_what_cannot_be_meant_is_refused_with_its_line(text: str, complaint: str) -> None:
    with pytest.raises(UnusableAssetError, match=complaint) as refusal:
        read_model(text.encode(), {})
    assert refusal.value.code == "asset_unusable"


def test_free_forms_alone_are_not_supported() -> None:
    with pytest.raises(UnusableAssetError, match="free-form") as refusal:
        read_model(f"{TRIANGLE}surf 0 1 0 1 1 2 3".encode(), {})
    assert refusal.value.code == "asset_unsupported"


@pytest.mark.parametrize(
    ("text", "complaint"),
    [
        (TRIANGLE + "f" + " 1 2 3" * 3_333_334, "10000000 triangles"),
        (TRIANGLE + "f" + " 1 2 3" * 30_000, "a face has 90000 corners"),
        (TRIANGLE + "f 1 2 3\n" * 4_200_000, "4200000 faces"),
        ("v 0\n" * 8_400_000 + "f 1 1 1", "8400000 vertices"),
        (TRIANGLE + "".join(f"usemtl {i}\nf 1 2 3\n" for i in range(5000)), "5000 materials"),
    ],
    ids=["corners", "face", "faces", "vertices", "materials"],
)
def test_what_is_too_large_is_refused_as_such(text: str, complaint: str) -> None:
    with pytest.raises(UnusableAssetError, match=complaint) as refusal:
        read_model(text.encode(), {})
    assert refusal.value.code == "asset_too_large"


def test_a_material_library_has_to_be_in_the_set_and_nothing_else_is_read() -> None:
    text = f"mtllib ../../../../etc/passwd\n{TRIANGLE}usemtl a\nf 1 2 3".encode()

    with pytest.raises(AssetMissingError, match="a file passwd, which is not in") as missing:
        read_model(text, {"other.mtl": b"newmtl a"})
    assert missing.value.code == "asset_file_missing"
    (surface,) = read_model(text, {"passwd": b"newmtl a\nKd 1 0 0"}).surfaces
    assert surface.surface.diffuse_color == [1, 0, 0]  # type: ignore[attr-defined]


def test_libraries_with_blanks_in_their_names_and_several_on_a_line() -> None:
    text = f"mtllib my first.mtl second.MTL\n{TRIANGLE}usemtl b\nf 1 2 3".encode()
    files = {"my first.mtl": b"newmtl a", "second.MTL": b"newmtl b\nKd 0 1 0"}

    assert obj.outline(text).files == ("my first.mtl", "second.MTL")
    (surface,) = read_model(text, files).surfaces
    assert surface.surface == PhongSpec(technique="phong", diffuse_color=[0, 1, 0])


def test_a_material_that_no_library_has_is_plain_and_warned_of() -> None:
    text = f"mtllib a.mtl\n{TRIANGLE}usemtl b\nf 1 2 3".encode()
    model = read_model(text, {"a.mtl": b"newmtl a"})

    assert model.surfaces[0].surface == PhongSpec(technique="phong")
    assert model.warnings == ("material b is in no library: it is plain grey",)


@given(st.binary(max_size=3), st.integers(0, 200), st.integers(0, 30))
def test_damage_is_read_or_refused_by_name(noise: bytes, at: int, cut: int) -> None:
    whole = (ROOF + "vt 0 1\nvn 0 0 1\ns 1\ng a\n" + SLOPES + "f 1/1/1 2/1/1 -1//1\nl 1 2").encode()
    damaged = whole[:at] + noise + whole[at + cut :]

    assert outcome(damaged, {}) in ("read", "asset_unusable", "asset_unsupported")


@pytest.mark.corpus
@pytest.mark.parametrize(
    "name", ["meshes/spot.obj", "pyrender/fuze.obj", "pyrender/wood.obj", "trimesh/ico4uv.obj"]
)
def test_every_corner_of_known_models_has_its_own_texture_coordinates(
    corpus: Path, name: str
) -> None:
    path = corpus / "1_models" / name
    lines = [line.split() for line in path.read_text().splitlines() if line]
    v, vt = ([[float(n) for n in w[1:]] for w in lines if w[0] == word] for word in ("v", "vt"))
    corners = [word.split("/") for w in lines if w[0] == "f" for word in w[1:]]
    files = {other.name: other.read_bytes() for other in path.parent.iterdir()}

    (part,) = read_model(path.read_bytes(), files).parts

    order = part.mesh.triangles.ravel()
    assert part.mesh.positions[order].tolist() == [v[int(c[0]) - 1][:3] for c in corners]
    assert part.mesh.uv(0)[order].tolist() == [vt[int(c[1]) - 1][:2] for c in corners]
