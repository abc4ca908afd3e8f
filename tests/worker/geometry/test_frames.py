"""Directions of u and v: closed forms and what topology says (T14, T15, T16)."""

from dataclasses import replace

import numpy as np
import pytest

from worker.geometry.box import box
from worker.geometry.cylinder import cylinder
from worker.geometry.frames import framed, sphere_frame, surface_frame
from worker.geometry.mesh import Mesh
from worker.geometry.plane import plane
from worker.geometry.singularities import singularities
from worker.geometry.sphere import sphere
from worker.geometry.torus import torus

POINT = np.array([np.pi / 3]), np.array([np.pi / 4])


def test_t14_the_frame_of_the_sphere_at_the_point_of_the_reference() -> None:
    place, east, north = sphere_frame(*POINT)

    np.testing.assert_allclose(place, [[0.353553391, 0.707106781, 0.612372436]], atol=1e-9)
    np.testing.assert_allclose(east, [[-0.612372436, 0, 0.353553391]], atol=1e-9)
    np.testing.assert_allclose(north, [[-0.353553391, 0.707106781, -0.612372436]], atol=1e-9)


def test_t14_its_lengths_are_those_of_parallels_and_meridians() -> None:
    rng = np.random.default_rng(0)
    longitude, latitude = rng.uniform(0, 2 * np.pi, 100), rng.uniform(-np.pi / 2, np.pi / 2, 100)

    place, east, north = sphere_frame(longitude, latitude)

    np.testing.assert_allclose(np.linalg.norm(east, axis=1), np.cos(latitude), atol=1e-12)
    np.testing.assert_allclose(np.linalg.norm(north, axis=1), 1, atol=1e-12)
    np.testing.assert_allclose((east * north).sum(axis=1), 0, atol=1e-12)
    inwards = np.cross(east, north)
    assert ((inwards * place).sum(axis=1) < 0).all()


def test_t14_it_is_the_derivative_of_the_place() -> None:
    step = 1e-6
    _, east, north = sphere_frame(*POINT)

    for number, exact in enumerate((east, north)):
        ends = [
            sphere_frame(*(value + side * step * (i == number) for i, value in enumerate(POINT)))[0]
            for side in (1, -1)
        ]
        np.testing.assert_allclose((ends[0] - ends[1]) / (2 * step), exact, atol=1e-9)


def test_t15_frames_are_orthonormal_and_e2_leads_where_v_grows() -> None:
    rng = np.random.default_rng(1)
    along_u, along_v = rng.normal(size=(50, 3)), rng.normal(size=(50, 3))
    normals = np.cross(along_u, along_v) * rng.choice([-1.0, 1.0], 50)[:, None]
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)

    first, second, side = surface_frame(along_u, along_v, normals)

    frames = np.stack([first, second, normals], axis=1)
    identity = np.broadcast_to(np.eye(3), (50, 3, 3))
    np.testing.assert_allclose(frames @ frames.transpose(0, 2, 1), identity, atol=1e-12)
    assert ((second * along_v).sum(axis=1) > 0).all()
    np.testing.assert_array_equal(
        side, np.sign(np.linalg.det(np.stack([along_u, along_v, normals], axis=1)))
    )


def test_t15_with_the_outward_normal_the_sphere_of_t14_is_mirrored() -> None:
    place, east, north = sphere_frame(*POINT)

    first, second, side = surface_frame(east, north, place)

    assert side[0] == -1
    np.testing.assert_allclose(second, north, atol=1e-12)
    np.testing.assert_allclose(first, east / np.cos(np.pi / 4), atol=1e-12)


@pytest.mark.parametrize(
    ("along_u", "along_v"),
    [([0, 0, 0], [0, 1, 0]), ([1, 0, 0], [0, 0, 0]), ([1, 2, 0], [-2, -4, 0])],
)
def test_t15_what_is_degenerate_has_no_frame(along_u: list[float], along_v: list[float]) -> None:
    u, v, n = (np.array([vector], dtype=float) for vector in (along_u, along_v, [0, 0, 1]))

    first, second, side = surface_frame(u, v, n)

    assert side[0] == 0
    assert not first.any()
    assert not second.any()


@pytest.mark.parametrize("frames", ["averaged", "sphere"])
def test_on_a_globe_tangents_are_its_parallels(frames: str) -> None:
    done = framed(sphere(2.0, 40, 20), frames, 0)  # type: ignore[arg-type]

    assert done.tangents is not None
    angle = 2 * np.pi * done.uv()[:, 0]
    east = np.stack([-np.sin(angle), 0 * angle, -np.cos(angle)], axis=1)
    away = np.abs(done.positions[:, 1]) < 1.99
    # A mean leans by half a facet's angle at the seam, where triangles are on one side only.
    exact = 1e-12 if frames == "sphere" else np.pi / 40 + 1e-3
    np.testing.assert_allclose(done.tangents[away, :3], east[away], atol=exact)
    assert (done.tangents[:, 3] == 1).all()


def test_parallels_lead_where_u_grows_on_a_sky_too() -> None:
    done = framed(sphere(1.0, 16, 8, flip_u=False), "sphere", 0)

    assert done.tangents is not None
    here = np.flatnonzero(np.isclose(done.positions, [1, 0, 0], atol=1e-12).all(axis=1))
    np.testing.assert_allclose(
        done.tangents[here], np.tile([0, 0, 1, -1.0], (len(here), 1)), atol=1e-12
    )


def test_t16_a_mean_is_weighted_by_the_size_on_the_picture() -> None:
    # Two triangles share the origin: one leads u along x with an area of 1/2, one along y with 1.
    positions = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [-1, 0, 0], [0, -1, 0]], dtype=float)
    uv = np.array([[0, 0], [1, 0], [0, 1], [0, -1], [-2, 0]], dtype=float)
    mesh = Mesh(
        positions=positions,
        normals=np.tile([0.0, 0.0, 1.0], (5, 1)),
        uv_sets=(uv,),
        triangles=np.array([[0, 1, 2], [0, 3, 4]], dtype=np.uint32),
    )

    done = framed(mesh, "averaged", 0)

    # f1 = dv2 w1 - dv1 w2: (1, 0, 0), and 1 (0, -1, 0) of the other, whose determinant is -2
    assert done.tangents is not None
    middle = done.tangents[~done.positions.any(axis=1)]
    sides = {tuple(tangent) for tangent in np.round(middle, 12).tolist()}
    assert sides == {(1.0, 0.0, 0.0, 1.0), (0.0, 1.0, 0.0, -1.0)}


@pytest.mark.parametrize("frames", ["averaged", "sphere"])
def test_mirrored_charts_are_parted_and_flagged(frames: str) -> None:
    flat = plane(2.0, 2.0, "+z")
    mirrored = replace(flat, uv_sets=(flat.uv() * [-1, 1],))

    done = framed(mirrored, frames, 0)  # type: ignore[arg-type]

    assert done.tangents is not None
    assert (done.tangents[:, 3] == -1).all()
    assert singularities(mirrored).mirrored == 2
    if frames == "averaged":
        np.testing.assert_allclose(done.tangents[:, :3], np.tile([-1.0, 0, 0], (4, 1)), atol=1e-12)


@pytest.mark.parametrize("frames", ["averaged", "sphere", "mikktspace"])
def test_charts_without_area_still_have_unit_tangents(frames: str) -> None:
    flat = plane(2.0, 2.0, "+z")
    squeezed = replace(flat, uv_sets=(np.zeros((4, 2)),))

    done = framed(squeezed, frames, 0)  # type: ignore[arg-type]

    assert done.tangents is not None
    np.testing.assert_allclose(np.linalg.norm(done.tangents[:, :3], axis=1), 1, atol=1e-12)
    np.testing.assert_allclose(done.tangents[:, 2], 0, atol=1e-12)
    assert singularities(squeezed).degenerate == 2


@pytest.mark.parametrize("size", [(36, 18), (7, 5), (64, 32)])
@pytest.mark.parametrize("flip_u", [True, False])
def test_t16_a_sphere_has_index_two_and_it_lies_at_the_poles(
    size: tuple[int, int], flip_u: bool
) -> None:
    found = singularities(sphere(1.5, *size, flip_u=flip_u))

    # Poincare and Hopf; the field runs once round each pole.
    assert found.index_sum == 2
    assert sorted(found.places.tolist()) == [[0.0, -1.5, 0.0], [0.0, 1.5, 0.0]]
    assert found.indices.tolist() == [1, 1]


def test_t16_a_torus_needs_no_singular_vertex() -> None:
    found = singularities(torus(3.0, 1.0, 24, 12))

    assert (found.index_sum, len(found.places)) == (0, 0)


def test_t16_whatever_the_charts_indices_of_a_closed_surface_add_up_to_its_characteristic() -> None:
    rng = np.random.default_rng(2)
    for closed, characteristic in (
        (sphere(1.0, 12, 7), 2),
        (box(1.0, 2.0, 3.0), 2),
        (cylinder(1.0, 2.0, 9, 2, caps=True), 2),
        (torus(2.0, 0.5, 9, 6), 0),
    ):
        random = replace(closed, uv_sets=(rng.random((len(closed.positions), 2)),))

        assert singularities(random).index_sum == characteristic
        assert singularities(random).indices.sum() == characteristic


def test_an_open_surface_has_no_sum() -> None:
    assert singularities(plane(1.0, 1.0, "+y")).index_sum is None
    assert singularities(cylinder(1.0, 2.0, 9, 2)).index_sum is None


def test_a_vortex_in_a_plane_is_found() -> None:
    # A fan of six triangles whose u runs round the middle
    angle = np.arange(6) * np.pi / 3
    rim = np.stack([np.cos(angle), np.sin(angle), 0 * angle], axis=1)
    positions = np.concatenate([np.zeros((6, 3)), rim, rim[:1]])
    uv = np.array([[(i + 0.5) / 6, 0] for i in range(6)] + [[i / 6, 1] for i in range(7)])
    mesh = Mesh(
        positions=positions,
        normals=np.tile([0.0, 0.0, 1.0], (13, 1)),
        uv_sets=(uv,),
        triangles=np.array([[i, 6 + i, 7 + i] for i in range(6)], dtype=np.uint32),
    )

    found = singularities(mesh)

    assert found.places.tolist() == [[0.0, 0.0, 0.0]]
    assert found.indices.tolist() == [1]


def test_a_report_tells_the_first_places_and_how_many_there_are() -> None:
    rng = np.random.default_rng(2)
    ball = sphere(1.0, 40, 20)
    noisy = replace(ball, uv_sets=(rng.random((len(ball.positions), 2)),))

    told = singularities(noisy).as_report()

    assert told["singular_vertices"] > 32 == len(told["singular"])
    assert set(told["singular"][0]) == {"position", "index"}
    assert told["index_sum"] == 2
