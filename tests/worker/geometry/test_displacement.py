"""Vertices moved along their normals: closed forms, and no cracks (T38, T48)."""

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from tests.worker.geometry.test_subdivision import SHAPES, border, shape, volume
from worker.geometry.displacement import displaced
from worker.geometry.mesh import Mesh
from worker.geometry.plane import plane
from worker.geometry.sphere import sphere
from worker.geometry.subdivision import subdivided
from worker.geometry.topology import weld


def random_heights(mesh: Mesh) -> np.ndarray:
    return 0.1 * np.random.default_rng(5).random(len(mesh.positions))


@pytest.mark.parametrize("name", SHAPES)
def test_random_heights_at_every_vertex_open_no_crack(name: str) -> None:
    mesh = subdivided(shape(name), 3)

    moved = displaced(mesh, random_heights(mesh))

    assert border(moved) == 0
    # What was one place is one place still, edges and seams with two normals or two uv included.
    before, after = weld(mesh.positions), weld(moved.positions)
    assert len(np.unique(np.stack([before, after]), axis=1).T) == before.max() + 1


def test_vertices_at_one_place_go_by_the_mean_of_their_ways() -> None:
    mesh = shape("box")
    heights = np.arange(len(mesh.positions)) / 10.0

    moved = displaced(mesh, heights)

    corner = np.array([1.0, 1.0, 1.0])
    here = np.flatnonzero((mesh.positions == corner).all(axis=1))
    assert len(here) == 3
    expected = corner + (mesh.normals[here] * heights[here, None]).mean(axis=0)
    np.testing.assert_allclose(moved.positions[here], np.tile(expected, (3, 1)), atol=1e-15)


def test_t48_a_ball_moved_out_by_a_tenth_has_the_volume_of_a_larger_ball() -> None:
    errors = []
    for rings in (64, 128):
        ball = sphere(1.0, 2 * rings, rings)
        moved = displaced(ball, np.full(len(ball.positions), 0.1))
        errors.append(1 - volume(moved) / 5.575279763)  # 4 pi / 3 * 1.1^3

    # Facets lie within the ball: the error falls with the square of their size.
    assert errors[1] == pytest.approx(errors[0] / 4, rel=2e-3)
    assert 0 < errors[1] < 3e-4


def test_t48_nothing_moved_is_nothing_changed() -> None:
    ball = sphere(1.0, 32, 16)

    still = displaced(ball, np.zeros(len(ball.positions)))

    np.testing.assert_array_equal(still.positions, ball.positions)
    np.testing.assert_allclose(still.normals, ball.normals, atol=1e-15)


def test_moved_alike_everywhere_a_ball_keeps_its_normals() -> None:
    ball = sphere(1.0, 32, 16)

    moved = displaced(ball, np.full(len(ball.positions), 0.5))

    np.testing.assert_allclose(moved.normals, ball.normals, atol=1e-12)


def test_normals_are_those_of_the_new_surface() -> None:
    # A wave .1 sin(2 pi x) on a fine plane: n = (-.2 pi cos(2 pi x), 0, 1)
    flat = subdivided(plane(1.0, 1.0, "+z"), 7)
    x = flat.positions[:, 0]

    moved = displaced(flat, 0.1 * np.sin(2 * np.pi * x))

    slope = 0.2 * np.pi * np.cos(2 * np.pi * x)
    expected = np.stack([-slope, 0 * x, np.ones_like(x)], axis=1)
    expected /= np.linalg.norm(expected, axis=1, keepdims=True)
    inside = (np.abs(flat.positions[:, :2]) < 0.499).all(axis=1)
    # Means over cells of h = 1/128 find a slope's second derivative: (2 pi h)^2 / 6 = 4e-4 of it.
    np.testing.assert_allclose(moved.normals[inside], expected[inside], atol=5e-4)


def test_sharp_edges_stay_sharp() -> None:
    box = subdivided(shape("box"), 2)

    moved = displaced(box, np.full(len(box.positions), 0.2))

    middle = np.flatnonzero((box.positions == [0, 0, 1]).all(axis=1))
    edge = np.flatnonzero((box.positions == [1, 0, 1]).all(axis=1))
    np.testing.assert_allclose(moved.normals[middle], [[0, 0, 1]], atol=1e-12)
    assert len(edge) == 2
    assert abs(moved.normals[edge[0]] @ moved.normals[edge[1]]) < 0.5


@pytest.mark.parametrize("name", SHAPES)
@pytest.mark.parametrize("height", [1e6, -1e6, -1.0])
def test_any_height_leaves_unit_normals(name: str, height: float) -> None:
    mesh = shape(name)

    moved = displaced(mesh, np.full(len(mesh.positions), height))

    assert np.isfinite(moved.positions).all()
    np.testing.assert_allclose(np.linalg.norm(moved.normals, axis=1), 1, atol=1e-12)


def test_tangents_of_a_file_do_not_fit_what_has_moved() -> None:
    mesh = replace(shape("box"), tangents=np.ones((24, 4)))

    assert displaced(mesh, random_heights(mesh)).tangents is None


@pytest.mark.parametrize("kind", ["lines", "points"])
def test_lines_and_points_stay(kind: Any) -> None:
    mesh = replace(shape("box"), kind=kind)

    assert displaced(mesh, random_heights(mesh)) is mesh
