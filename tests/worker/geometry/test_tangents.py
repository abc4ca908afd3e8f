"""Tangents against derivatives worked out by hand, and against the rules of MikkTSpace."""

import json
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra import numpy as arrays

from worker.geometry.cylinder import cylinder
from worker.geometry.mesh import Mesh
from worker.geometry.sphere import sphere
from worker.geometry.tangents import triangle_tangents, with_tangents
from worker.geometry.torus import torus

REFERENCE = Path(__file__).with_name("mikktspace.json")
FLAT = np.array([0.0, 0.0, 1.0])


def flat(positions: Any, uv: Any, triangles: Any, normals: Any = None) -> Mesh:
    places = np.array(positions, dtype=np.float64)
    if places.shape[1] == 2:
        places = np.hstack([places, np.zeros((len(places), 1))])
    return Mesh(
        positions=places,
        normals=np.tile(FLAT, (len(places), 1)) if normals is None else normals,
        uv_sets=(np.array(uv, dtype=np.float64),),
        triangles=np.array(triangles, dtype=np.uint32),
    )


def corner_tangents(mesh: Mesh) -> np.ndarray:
    made = with_tangents(mesh)
    assert made.tangents is not None
    return made.tangents[made.triangles]


def test_the_tangents_of_one_triangle() -> None:
    # T16 and A3 of the reference
    positions = np.array([[0, 0, 0], [2, 0, 0], [0, 3, 1]], dtype=np.float64)
    uv = np.array([[0, 0], [1, 0], [0.5, 2]])

    along_u, along_v, determinant = triangle_tangents(positions, uv, np.array([[0, 1, 2]]))

    np.testing.assert_allclose(along_u, [[4, 0, 0]], atol=1e-12)
    np.testing.assert_allclose(along_v, [[-1, 3, 1]], atol=1e-12)
    np.testing.assert_allclose(determinant, [2], atol=1e-12)


def test_v_is_constant_along_f1_and_u_along_f2() -> None:
    rng = np.random.default_rng(7)
    positions, uv = rng.normal(size=(30, 3)), rng.normal(size=(30, 2))
    triangles = np.arange(30).reshape(10, 3)

    along_u, along_v, determinant = triangle_tangents(positions, uv, triangles)

    # Positions are P0 + u' Pu + v' Pv; the linear map from positions in the plane back to (u, v)
    for corner, f1, f2, area in zip(triangles, along_u, along_v, determinant, strict=True):
        edges = positions[corner[1:]] - positions[corner[0]]
        charts = uv[corner[1:]] - uv[corner[0]]
        uv_from_plane = np.linalg.lstsq(edges, charts, rcond=None)[0]
        np.testing.assert_allclose(f1 @ uv_from_plane, [area, 0], atol=1e-9)
        np.testing.assert_allclose(f2 @ uv_from_plane, [0, area], atol=1e-9)


@pytest.mark.parametrize("shape", ["cylinder", "torus", "sphere"])
def test_round_shapes_have_the_tangents_of_their_parametrisation(shape: str) -> None:
    made = {
        "cylinder": cylinder(2, 3, 40, 5),
        "torus": torus(3, 1, 40, 20),
        "sphere": sphere(1, 40, 20),
    }
    mesh = made[shape]

    done = with_tangents(mesh)

    assert done.tangents is not None
    angle = 2 * np.pi * done.uv()[:, 0]
    east = np.stack([-np.sin(angle), 0 * angle, -np.cos(angle)], axis=1)
    # At seams and poles one side of the fan is missing: there the mean leans by a facet's angle.
    inside = (done.uv() % 1 > 1e-9).all(axis=1)
    np.testing.assert_allclose(done.tangents[inside, :3], east[inside], atol=1e-12)
    np.testing.assert_allclose(done.tangents[:, :3], east, atol=np.pi / 40 + 1e-3)
    assert (done.tangents[:, 3] == 1).all()
    np.testing.assert_array_equal(done.positions[done.triangles], mesh.positions[mesh.triangles])
    np.testing.assert_array_equal(done.uv()[done.triangles], mesh.uv()[mesh.triangles])


def test_a_sphere_without_its_poles_has_index_two() -> None:
    # Poincare and Hopf: a field of tangents on a sphere has zeros whose indices add up to two. Here
    # it runs once round each pole, whose vertices have a copy and a tangent for every triangle.
    done = with_tangents(sphere(1, 36, 18))

    assert done.tangents is not None
    for pole in (-1, 1):
        at_pole = done.positions[:, 1] * pole > 1 - 1e-12
        angle = np.sort(np.arctan2(done.tangents[at_pole, 2], done.tangents[at_pole, 0]))
        np.testing.assert_allclose(np.diff(angle), 2 * np.pi / 36, atol=1e-9)


def test_a_mirrored_chart_has_a_negative_sign_and_u_still_grows_along_the_tangent() -> None:
    mesh = flat([[0, 0], [1, 0], [0, 1]], [[1, 0], [0, 0], [1, 1]], [[0, 1, 2]])

    tangents = corner_tangents(mesh)

    np.testing.assert_allclose(tangents[0], np.tile([-1.0, 0.0, 0.0, -1.0], (3, 1)), atol=1e-15)


def test_vertices_are_split_where_charts_mirror_each_other() -> None:
    mesh = flat(
        [[-1, 0], [0, 0], [1, 0], [0, 1]],
        [[0, 0], [1, 0], [0, 0], [1, 1]],
        [[0, 1, 3], [1, 2, 3]],
    )

    done = with_tangents(mesh)

    assert len(done.positions) == 6
    tangents = corner_tangents(mesh)
    np.testing.assert_allclose(tangents[0], np.tile([1.0, 0.0, 0.0, 1.0], (3, 1)), atol=1e-15)
    np.testing.assert_allclose(tangents[1], np.tile([-1.0, 0.0, 0.0, -1.0], (3, 1)), atol=1e-15)


def test_the_mean_is_weighted_by_the_angles_at_the_vertex() -> None:
    # 90 degrees at the origin in the first triangle, where u grows along x; 45 in the second, whose
    # edges (0, 1) and (-1, 1) have (0, 1) and (-1, 2) in uv: u grows along (1, 1) there.
    mesh = flat(
        [[0, 0], [1, 0], [0, 1], [-1, 1]],
        [[0, 0], [1, 0], [0, 1], [-1, 2]],
        [[0, 1, 2], [0, 2, 3]],
    )
    along = np.array([1.0, 1.0, 0.0]) / np.sqrt(2)

    tangents = corner_tangents(mesh)

    expected = np.pi / 2 * np.array([1, 0, 0]) + np.pi / 4 * along
    expected /= np.linalg.norm(expected)
    np.testing.assert_allclose(tangents[0, 0, :3], expected, atol=1e-12)
    np.testing.assert_allclose(tangents[1, 0, :3], expected, atol=1e-12)
    np.testing.assert_allclose(tangents[1, 2, :3], along, atol=1e-12)


@pytest.mark.parametrize("case", ["half of it mirrored", "each triangle anyhow"])
def test_other_programs_find_the_same_tangents(case: str) -> None:
    # What mikktspace 1.1.1 of npm, a port of Mikkelsen's own code, says of two crumpled sheets. It
    # counts in float32, and a triangle's uv may be a sliver.
    cases = json.loads(REFERENCE.read_text())
    given = cases[["half of it mirrored", "each triangle anyhow"].index(case)]
    mesh = flat(given["positions"], given["uv"], given["triangles"], np.array(given["normals"]))

    tangents = corner_tangents(mesh)

    np.testing.assert_allclose(tangents.reshape(-1, 4), given["tangents"], atol=2e-6)
    assert {-1.0, 1.0} == set(tangents[..., 3].ravel())


def test_copies_of_a_vertex_are_one_vertex() -> None:
    shared = flat(
        [[0, 0], [1, 0], [1, 1], [0, 1]],
        [[0, 0], [1, 0.3], [1, 1], [0.2, 1]],
        [[0, 1, 2], [0, 2, 3]],
    )
    soup = flat(
        shared.positions[shared.triangles].reshape(-1, 3),
        shared.uv()[shared.triangles].reshape(-1, 2),
        np.arange(6).reshape(2, 3),
    )

    np.testing.assert_allclose(corner_tangents(soup), corner_tangents(shared), atol=1e-15)


def test_a_seam_in_uv_parts_the_tangents() -> None:
    # Equal places and normals, but the second chart is turned by a quarter and lies elsewhere.
    mesh = flat(
        [[0, 0], [1, 0], [1, 1], [0, 0], [1, 1], [0, 1]],
        [[0, 0], [1, 0], [1, 1], [5, 0], [4, 1], [4, 0]],
        [[0, 1, 2], [3, 4, 5]],
    )

    tangents = corner_tangents(mesh)

    np.testing.assert_allclose(tangents[0, :, :3], np.tile([1, 0, 0], (3, 1)), atol=1e-15)
    np.testing.assert_allclose(tangents[1, :, :3], np.tile([0, -1, 0], (3, 1)), atol=1e-15)


def test_tangents_lie_across_the_normal_of_the_vertex() -> None:
    leaning = np.tile([0.6, 0.0, 0.8], (3, 1))
    mesh = flat([[0, 0], [1, 0], [0, 1]], [[0, 0], [1, 0], [0, 1]], [[0, 1, 2]], leaning)

    tangents = corner_tangents(mesh)

    # x, less its part along the normal: (1, 0, 0) - 0.6 (0.6, 0, 0.8) = (0.64, 0, -0.48)
    np.testing.assert_allclose(tangents[0, 0], [0.8, 0, -0.6, 1], atol=1e-12)


def test_a_triangle_without_a_direction_follows_its_neighbours() -> None:
    # The middle one of three has no area in uv: it holds the group at the shared vertex together.
    mesh = flat(
        [[0, 0], [1, 0], [1, 1], [0, 1], [-1, 1]],
        [[0, 0], [1, 0], [1, 1], [1, 1], [-1, 1]],
        [[0, 1, 2], [0, 2, 3], [0, 3, 4]],
    )

    tangents = corner_tangents(mesh)

    # Angles of 45 degrees each; u grows along x in the first, and along what its edges say in the
    # third, whose edges (0, 1) and (-1, 1) have (1, 1) and (-1, 1) in uv.
    third = np.array([2.0, 0, 0]) / 2
    expected = np.array([1.0, 0, 0]) + third / np.linalg.norm(third)
    expected /= np.linalg.norm(expected)
    for triangle in range(3):
        np.testing.assert_allclose(tangents[triangle, 0, :3], expected, atol=1e-12)


@pytest.mark.parametrize("uv", [[[0, 0]] * 3, [[0, 0], [1, 1], [2, 2]], [[0, 0], [0, 1], [0, 2]]])
def test_where_uv_gives_no_direction_any_across_the_normal_is_taken(uv: Any) -> None:
    normals = np.array([[0, 0, 1], [0.6, 0, 0.8], [0, 1, 0]], dtype=np.float64)
    mesh = flat([[0, 0], [1, 0], [0, 1]], uv, [[0, 1, 2]], normals)

    tangents = corner_tangents(mesh)[0]

    np.testing.assert_allclose(np.linalg.norm(tangents[:, :3], axis=1), 1, atol=1e-12)
    np.testing.assert_allclose((tangents[:, :3] * normals).sum(axis=1), 0, atol=1e-12)


def test_a_file_that_brings_tangents_keeps_them() -> None:
    mesh = replace(sphere(1, 8, 4), tangents=np.zeros((45, 4)))

    assert with_tangents(mesh) is mesh


@pytest.mark.parametrize(("kind", "width"), [("lines", 2), ("points", 1), ("triangles", 3)])
def test_what_has_no_triangles_has_no_tangents(kind: Any, width: int) -> None:
    count = 0 if kind == "triangles" else 4
    rows = np.zeros((count, width), dtype=np.uint32)
    mesh = replace(flat([[0, 0]], [[0, 0]], rows), kind=kind)

    assert with_tangents(mesh) is mesh


def test_colours_and_all_uv_sets_stay_at_their_vertices() -> None:
    mesh = torus(3, 1, 6, 4)
    rng = np.random.default_rng(3)
    colours, other = rng.random((len(mesh.positions), 4)), rng.random((len(mesh.positions), 2))
    mesh = replace(mesh, colors=colours, uv_sets=(mesh.uv(), other))

    done = with_tangents(mesh, uv_set=1)

    assert done.colors is not None
    np.testing.assert_array_equal(done.colors[done.triangles], colours[mesh.triangles])
    np.testing.assert_array_equal(done.uv(1)[done.triangles], other[mesh.triangles])


def test_hostile_fans_and_strips_take_no_more_than_their_time() -> None:
    # All triangles share one edge; a strip without uv hangs on one good triangle.
    count = 20_000
    pages = flat(
        np.vstack([[[0, 0, 0], [0, 0, 1]], np.random.default_rng(0).random((count, 3))]),
        np.vstack([[[0, 0], [0, 1]], np.random.default_rng(1).random((count, 2))]),
        np.stack([np.zeros(count), np.ones(count), 2 + np.arange(count)], axis=1),
    )
    column = np.arange(count + 2)
    strip = flat(
        np.stack([column / 2, column % 2], axis=1),
        np.where(column[:, None] < 3, np.stack([column / 2, column % 2], axis=1), [9.0, 9.0]),
        np.stack([column[:-2], column[1:-1], column[2:]], axis=1),
    )

    for mesh in (pages, strip):
        done = with_tangents(mesh)
        assert done.tangents is not None
        assert np.isfinite(done.tangents).all()


@settings(max_examples=60, deadline=None)
@given(
    positions=arrays.arrays(np.float64, (7, 3), elements=st.sampled_from([0, 1, -1, 1e-30, 3e37])),
    uv=arrays.arrays(np.float64, (7, 2), elements=st.sampled_from([0, -0.0, 1, -1, 1e-30, 3e37])),
    triangles=arrays.arrays(np.uint32, (9, 3), elements=st.integers(0, 6)),
)
def test_whatever_lies_where_tangents_are_unit_and_signs_are_signs(
    positions: np.ndarray, uv: np.ndarray, triangles: np.ndarray
) -> None:
    normals = np.tile([0.0, 0.6, 0.8], (7, 1))
    mesh = Mesh(positions, normals, (uv,), triangles)

    done = with_tangents(mesh)

    assert done.tangents is not None
    np.testing.assert_allclose(np.linalg.norm(done.tangents[:, :3], axis=1), 1, atol=1e-9)
    np.testing.assert_allclose(done.tangents[:, :3] @ normals[0], 0, atol=1e-9)
    assert set(done.tangents[:, 3]) <= {1.0, -1.0}
    np.testing.assert_array_equal(done.positions[done.triangles], positions[triangles])
