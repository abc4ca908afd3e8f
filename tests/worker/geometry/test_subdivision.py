"""Edges halved alike from both sides: nothing opens, nothing overlaps."""

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from api_schemas import meshes
from worker.geometry import primitives
from worker.geometry.mesh import Mesh
from worker.geometry.subdivision import subdivided
from worker.geometry.topology import shared_edges, weld

SHAPES: dict[str, dict[str, Any]] = {
    "sphere": {"segments": 7, "rings": 5},
    "box": {},
    "torus": {"segments": 9, "rings": 5},
    "cylinder": {"segments": 5, "caps": True},
}


def shape(name: str) -> Mesh:
    fields = SHAPES[name]
    kind = {"sphere": meshes.Sphere, "box": meshes.Box, "torus": meshes.Torus}
    spec = kind.get(name, meshes.Cylinder).model_validate({"type": name, **fields})
    return primitives.build(spec)  # type: ignore[arg-type]


def border(mesh: Mesh) -> int:
    """How many edges have a triangle on one side only; vertices at one place are one."""
    corners = weld(mesh.positions)[mesh.triangles.astype(np.int64)]
    used = np.flatnonzero((corners != np.roll(corners, -1, axis=1)).all(axis=1))
    return 3 * len(used) - 2 * len(shared_edges(corners, used)[0])


def volume(mesh: Mesh) -> float:
    a, b, c = np.moveaxis(mesh.positions[mesh.triangles], 1, 0)
    return float((a * np.cross(b, c)).sum() / 6)


def longest(mesh: Mesh) -> float:
    places = mesh.positions[mesh.triangles]
    return float(np.linalg.norm(places - np.roll(places, 1, axis=1), axis=2).max())


@pytest.mark.parametrize("name", SHAPES)
def test_every_time_four_triangles_are_made_of_one(name: str) -> None:
    before = shape(name)

    after = subdivided(before, 2)

    assert len(after.triangles) == 16 * len(before.triangles)
    assert longest(after) == pytest.approx(longest(before) / 4)
    assert volume(after) == pytest.approx(volume(before), rel=1e-12)


@pytest.mark.parametrize("name", SHAPES)
@pytest.mark.parametrize("edge", [0.05, 0.3, 0.7, 1.5])
def test_whatever_edges_are_halved_nothing_opens(name: str, edge: float) -> None:
    before = shape(name)

    after = subdivided(before, 8, edge)

    assert border(after) == border(before) == 0
    assert longest(after) <= edge
    assert volume(after) == pytest.approx(volume(before), rel=1e-12)
    assert len(after.triangles) <= 4**8 * len(before.triangles)


def test_edges_that_are_short_enough_stay() -> None:
    before = shape("sphere")

    # Rounding: the longest one is not longer than a hair more than itself
    for same in (subdivided(before, 5, longest(before) + 1e-12), subdivided(before, 0)):
        np.testing.assert_array_equal(same.triangles, before.triangles)


@pytest.mark.parametrize("cut", range(8))
def test_each_way_of_halving_a_triangle_covers_it_once(cut: int) -> None:
    # Corners put so that just the edges wanted are longer than 1
    lengths = [1.2 if cut >> edge & 1 else 0.9 for edge in range(3)]
    a, b, c = lengths
    x = (a * a + c * c - b * b) / (2 * a)
    corners = np.array([[0, 0, 0], [a, 0, 0], [x, np.sqrt(c * c - x * x), 0]])
    mesh = Mesh(
        positions=corners,
        normals=np.tile([0.0, 0.0, 1.0], (3, 1)),
        uv_sets=(corners[:, :2],),
        triangles=np.array([[0, 1, 2]], dtype=np.uint32),
    )

    after = subdivided(mesh, 1, 1.0)

    assert len(after.triangles) == 1 + bin(cut).count("1")
    p, q, r = np.moveaxis(after.positions[after.triangles], 1, 0)
    areas = np.cross(q - p, r - p)[:, 2] / 2
    assert (areas > 0).all()
    assert areas.sum() == pytest.approx(a * corners[2, 1] / 2)
    np.testing.assert_array_equal(after.uv(), after.positions[:, :2])


def test_what_vertices_carry_is_halved_with_them() -> None:
    before = shape("box")
    colours = np.random.default_rng(0).random((len(before.positions), 4))
    before = replace(before, colors=colours, uv_sets=(before.uv(), 2 * before.uv()))

    after = subdivided(before, 1)

    np.testing.assert_array_equal(after.uv_sets[1], 2 * after.uv_sets[0])
    assert after.colors is not None
    np.testing.assert_array_equal(after.colors[: len(colours)], colours)
    np.testing.assert_allclose(np.linalg.norm(after.normals, axis=1), 1)


@pytest.mark.parametrize("kind", ["lines", "points"])
def test_lines_and_points_stay(kind: Any) -> None:
    columns = {"lines": 2, "points": 1}[kind]
    mesh = replace(
        shape("box"), kind=kind, triangles=np.zeros((4, columns), dtype=np.uint32), tangents=None
    )

    assert subdivided(mesh, 3) is mesh
