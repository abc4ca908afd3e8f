"""Primitives as meshes: normals, texture coordinates, tangents, colours, morph targets."""

import math
from typing import Any

import numpy as np
import pytest

from tests.worker.models.gltf.building import TRIANGLE, Builder, shown
from worker.errors import UnusableAssetError
from worker.geometry.mesh import Mesh
from worker.models.gltf.reader import read
from worker.models.model import Part

SQUARE = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]]
UP = [[0, 0, 1]] * 4
TOP_LEFT_FIRST = [[0, 1], [1, 1], [1, 0], [0, 0]]
"""glTF's coordinates of SQUARE for a picture that lies unmirrored on it: v runs down."""


def only_part(builder: Builder) -> Part:
    (part,) = read(builder.glb(), {}).parts
    return part


def mesh_of(builder: Builder, mesh: int = 0, **node: Any) -> Mesh:
    builder.json |= shown(mesh, **node)
    return only_part(builder).mesh


def test_a_node_that_mirrors_leaves_the_mesh_and_says_so_in_its_matrix() -> None:
    builder = Builder()
    builder.mesh()
    builder.json |= shown(0, scale=[-1, 1, 1])
    part = only_part(builder)

    assert part.mesh.triangles.tolist() == [[0, 1, 2]]
    assert np.linalg.det(part.matrix) == -1


def test_without_normals_each_triangle_is_flat_and_has_corners_of_its_own() -> None:
    builder = Builder()
    tangent = builder.accessor([[1, 0, 0, 1]] * 4)
    ridge = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, -1]]
    builder.mesh(ridge, [0, 1, 2, 0, 2, 3], {"TANGENT": tangent})
    mesh = mesh_of(builder)

    assert mesh.positions.tolist() == [ridge[i] for i in (0, 1, 2, 0, 2, 3)]
    assert mesh.normals.tolist() == [[0, 0, 1]] * 3 + [[-1, 0, 0]] * 3
    assert mesh.triangles.tolist() == [[0, 1, 2], [3, 4, 5]]
    assert mesh.tangents is None


def test_normals_are_brought_to_length_one_and_missing_ones_are_made() -> None:
    builder = Builder()
    normal = builder.accessor([[0, 0, 3], [0, 0, 0], [0, 1e-30, 0], [0, 3, 4]])
    builder.mesh(SQUARE, [0, 1, 2, 0, 2, 3], {"NORMAL": normal})

    normals = mesh_of(builder).normals

    assert normals == pytest.approx(
        np.array([[0, 0, 1], [0, 0, 1], [0, 1, 0], [0, 0.6, 0.8]]), abs=1e-7
    )


def test_lines_and_points_without_normals_have_none() -> None:
    for mode in range(4):
        builder = Builder()
        builder.mesh(SQUARE, mode=mode)
        mesh = mesh_of(builder)

        assert mesh.kind == ("points" if mode == 0 else "lines")
        assert not mesh.normals.any()


def test_v_is_turned_to_run_up_exactly_once() -> None:
    builder = Builder()
    attributes = {
        "NORMAL": builder.accessor(UP),
        "TEXCOORD_0": builder.accessor(TOP_LEFT_FIRST),
        "TEXCOORD_1": builder.accessor([[0, 0.25], [1, 2], [0, -1], [0, 0.5]]),
    }
    builder.mesh(SQUARE, [0, 1, 2, 0, 2, 3], attributes)
    mesh = mesh_of(builder)

    assert mesh.uv_sets[0].tolist() == [[0, 0], [1, 0], [1, 1], [0, 1]]
    assert mesh.uv_sets[1].tolist() == [[0, 0.75], [1, -1], [0, 2], [0, 0.5]]


def test_texture_coordinates_beyond_measure_are_refused() -> None:
    builder = Builder()
    builder.mesh(attributes={"TEXCOORD_0": builder.accessor([[0, 0], [2e9, 0], [0, 0]])})

    with pytest.raises(UnusableAssetError, match="texture coordinates beyond"):
        mesh_of(builder)


def test_only_four_sets_of_coordinates_are_read() -> None:
    builder = Builder()
    sets = {f"TEXCOORD_{n}": builder.accessor([[n, 0]] * 3) for n in range(6)}
    builder.mesh(attributes=sets)
    mesh = mesh_of(builder)

    assert [uv[0, 0] for uv in mesh.uv_sets] == [0, 1, 2, 3]


def test_the_sign_of_a_tangent_is_that_of_our_coordinates() -> None:
    # The picture lies unmirrored and is seen from +z, so that its right is +x and its up +y; by the
    # normal map's convention (+X right, +Y up) the bitangent w cross(n, t) is +y.
    builder = Builder()
    attributes = {
        "NORMAL": builder.accessor(UP),
        "TANGENT": builder.accessor([[2, 0, 0, 1]] * 4),
        "TEXCOORD_0": builder.accessor(TOP_LEFT_FIRST),
    }
    builder.mesh(SQUARE, [0, 1, 2, 0, 2, 3], attributes)
    mesh = mesh_of(builder)

    assert mesh.tangents is not None
    assert mesh.tangents.tolist() == [[1, 0, 0, 1]] * 4
    (u0, v0), (u1, v1), (u2, v2) = mesh.uv_sets[0][:3]
    edges = mesh.positions[1:3] - mesh.positions[0]
    jacobian = np.linalg.inv(np.array([[u1 - u0, u2 - u0], [v1 - v0, v2 - v0]]))
    along_u, along_v = (edges.T @ jacobian).T
    bitangent = mesh.tangents[0, 3] * np.cross(mesh.normals[0], mesh.tangents[0, :3])
    assert along_u == pytest.approx(mesh.tangents[0, :3])
    assert along_v == pytest.approx(bitangent)


@pytest.mark.parametrize("bad", [[0, 0, 0, 1], [1, 0, 0, 0]])
def test_tangents_that_say_nothing_are_dropped_with_a_warning(bad: list[float]) -> None:
    builder = Builder()
    attributes = {"NORMAL": builder.accessor(UP), "TANGENT": builder.accessor([bad] * 4)}
    builder.mesh(SQUARE, attributes=attributes)
    builder.json |= shown(0)
    model = read(builder.glb(), {})

    assert model.parts[0].mesh.tangents is None
    assert "tangents" in model.warnings[0]


def test_colours_of_vertices_are_linear_and_opaque_where_they_have_no_alpha() -> None:
    for color, dtype, expected in (
        ([0.25, 0.5, 1], "<f4", [0.25, 0.5, 1, 1]),
        ([0.25, 0.5, 1, 0.5], "<f4", [0.25, 0.5, 1, 0.5]),
        ([0, 51, 255, 51], "<u1", [0, 0.2, 1, 0.2]),
    ):
        builder = Builder()
        index = builder.accessor([color] * 3, dtype, normalized=dtype != "<f4")
        builder.mesh(attributes={"COLOR_0": index})
        colors = mesh_of(builder).colors

        assert colors is not None
        assert colors.tolist() == [expected] * 3


def test_only_vertices_in_use_are_kept() -> None:
    builder = Builder()
    many = np.zeros((1000, 3))
    many[[7, 500, 999]] = TRIANGLE
    for indices in ([7, 500, 999], [7, 500, 999] * 100):
        normal = builder.accessor(np.tile([0, 0, 1], (1000, 1)))
        mesh = builder.mesh(many, indices, {"NORMAL": normal})

        read_mesh = mesh_of(builder, mesh)
        assert read_mesh.positions.tolist() == TRIANGLE
        assert read_mesh.triangles[0].tolist() == [0, 1, 2]


def test_primitives_of_nothing_are_left_out_and_told() -> None:
    builder = Builder()
    builder.mesh(TRIANGLE[:2])
    nowhere = {"attributes": {"NORMAL": builder.accessor([[0, 0, 1]] * 3)}}
    builder.json["meshes"][0]["primitives"].append(nowhere)
    builder.json |= shown(0)
    model = read(builder.glb(), {})

    assert model.parts == ()
    assert model.warnings == (
        "a primitive with too few vertices is not drawn",
        "a primitive without positions is not drawn",
    )


def test_an_index_beyond_the_vertices_is_refused_where_it_stands() -> None:
    builder = Builder()
    builder.mesh(TRIANGLE, [0, 1, 3])
    builder.json |= shown(0)

    with pytest.raises(
        UnusableAssetError,
        match=r"^/meshes/0/primitives/0/indices: index 2 is 3, not below 3$",
    ):
        read(builder.glb(), {})


def test_the_index_that_would_restart_a_primitive_is_refused() -> None:
    builder = Builder()
    builder.mesh(np.zeros((65536, 3)), [0, 1, 65535])
    builder.json |= shown(0)

    with pytest.raises(UnusableAssetError, match="restart"):
        read(builder.glb(), {})


@pytest.mark.parametrize(
    ("attributes", "word"),
    [
        ({"POSITON": 0}, "no attribute POSITON"),
        ({"<script>": 0}, r"no attribute \?"),
        ({"POSITION": 0, "TEXCOORD_1": 1}, "not numbered from 0"),
        ({"POSITION": 1}, "format"),
        ({"POSITION": 0, "TEXCOORD_0": 0}, "format"),
        ({"POSITION": 0, "TEXCOORD_0": 2}, "different numbers"),
        ({"POSITION": 3}, "index 3 is not below 3"),
        ({}, "at least 1"),
    ],
)
def test_attributes_that_cannot_be_are_refused(attributes: dict[str, int], word: str) -> None:
    builder = Builder()
    builder.accessor(TRIANGLE)
    builder.accessor([[0, 0]] * 3)
    builder.accessor([[0, 0]] * 2)
    builder.json |= shown(builder.add("meshes", {"primitives": [{"attributes": attributes}]}))

    with pytest.raises(UnusableAssetError, match=word):
        read(builder.glb(), {})


def test_morph_targets_move_at_the_weights_of_the_node_else_of_the_mesh() -> None:
    builder = Builder()
    up = builder.accessor([[0, 0, 1]] * 3)
    lift, tilt = builder.accessor([[0, 0, 8]] * 3), builder.accessor([[1, 0, 0]] * 3)
    targets = [{"POSITION": lift, "NORMAL": tilt}, {"POSITION": tilt}]
    builder.mesh(attributes={"NORMAL": up}, targets=targets)
    builder.json["meshes"][0]["weights"] = [0.25, 0]
    builder.json |= {"nodes": [{"mesh": 0}, {"mesh": 0, "weights": [0, 3]}]}

    resting, moved = read(builder.glb(), {}).parts

    assert resting.mesh.positions.tolist() == [[0, 0, 2], [1, 0, 2], [0, 1, 2]]
    assert resting.mesh.normals[0] == pytest.approx(np.array([0.25, 0, 1]) / math.hypot(0.25, 1))
    assert moved.mesh.positions.tolist() == [[3, 0, 0], [4, 0, 0], [3, 1, 0]]
    assert resting.key != moved.key
