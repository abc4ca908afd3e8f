import math

import numpy as np
import pytest
from pydantic import TypeAdapter

from api_schemas.meshes import Mesh as MeshSpec
from worker.geometry.mesh import Mesh
from worker.geometry.primitives import build

SPECS = [
    {"type": "cylinder"},
    {"type": "cylinder", "segments": 10, "rows": 5},
    {"type": "cylinder", "segments": 3, "rows": 2, "caps": True},
    {"type": "sphere"},
    {"type": "sphere", "segments": 3, "rings": 2},
    {"type": "plane"},
    {"type": "plane", "width": 3.0, "facing": "+y"},
    {"type": "box", "width": 1.0, "depth": 3.0},
    {"type": "torus"},
    {"type": "torus", "segments": 3, "rings": 3},
    {"type": "disk"},
    {"type": "disk", "segments": 3, "facing": "+y"},
]
ADAPTER: TypeAdapter[MeshSpec] = TypeAdapter(MeshSpec)


def made(**spec: object) -> Mesh:
    return build(ADAPTER.validate_python(spec))


def crosses(mesh: Mesh) -> np.ndarray:
    corner = mesh.positions[mesh.triangles]
    return np.cross(corner[:, 1] - corner[:, 0], corner[:, 2] - corner[:, 0])


def area(mesh: Mesh) -> float:
    return float(np.linalg.norm(crosses(mesh), axis=1).sum() / 2)


def volume(mesh: Mesh) -> float:
    """The divergence theorem; exact for closed meshes wound outward."""
    corner = mesh.positions[mesh.triangles]
    return float(np.einsum("ij,ij", corner[:, 0], np.cross(corner[:, 1], corner[:, 2])) / 6)


def uv_areas(mesh: Mesh) -> np.ndarray:
    corner = mesh.uv()[mesh.triangles]
    x, y = corner[:, 1] - corner[:, 0], corner[:, 2] - corner[:, 0]
    return (x[:, 0] * y[:, 1] - x[:, 1] * y[:, 0]) / 2


@pytest.mark.parametrize("spec", SPECS, ids=str)
def test_triangles_are_as_many_as_the_spec_says_and_none_is_empty(spec: dict[str, object]) -> None:
    mesh = made(**spec)

    assert len(mesh.triangles) == ADAPTER.validate_python(spec).triangles
    assert np.linalg.norm(crosses(mesh), axis=1).min() > 0
    assert mesh.triangles.max() == len(mesh.positions) - 1


@pytest.mark.parametrize("spec", SPECS, ids=str)
def test_normals_are_unit_and_on_the_front_of_every_triangle(spec: dict[str, object]) -> None:
    mesh = made(**spec)

    faces = crosses(mesh)

    np.testing.assert_allclose(np.linalg.norm(mesh.normals, axis=1), 1, atol=1e-15)
    corner_normals = mesh.normals[mesh.triangles]
    assert np.einsum("ij,ij->i", faces, corner_normals.sum(axis=1)).min() > 0


@pytest.mark.parametrize("spec", SPECS, ids=str)
def test_text_is_unmirrored_on_every_triangle(spec: dict[str, object]) -> None:
    # With outward winding, a positive area in uv is det(P_u, P_v, n) > 0.
    assert uv_areas(made(**spec)).min() > 0


def test_a_sphere_for_the_inside_is_mirrored_on_every_triangle() -> None:
    assert uv_areas(made(type="sphere", flip_u=False)).max() < 0


def test_soda_can_has_66_vertices_and_100_triangles() -> None:
    # T01
    mesh = made(type="cylinder", radius=1.5, height=2.0, segments=10, rows=5)

    assert (len(mesh.positions), len(mesh.triangles)) == (66, 100)
    assert area(mesh) == pytest.approx(10 * 2 * 1.5 * math.sin(math.pi / 10) * 2.0, rel=1e-14)
    assert len(np.unique(mesh.positions, axis=0)) == 60
    i, j = np.meshgrid(np.arange(11), np.arange(6))
    a = 2 * np.pi * i / 10
    expected = np.stack([1.5 * np.cos(a), 2.0 * j / 5, -1.5 * np.sin(a)], axis=2).reshape(-1, 3)
    np.testing.assert_allclose(mesh.positions, expected, atol=1e-15)
    np.testing.assert_array_equal(mesh.uv(), np.stack([i / 10, j / 5], axis=2).reshape(-1, 2))


@pytest.mark.parametrize("spec", [SPECS[0], SPECS[8]], ids=str)
def test_seam_is_equal_in_position_and_one_apart_in_u(spec: dict[str, object]) -> None:
    mesh = made(**spec)

    first, last = mesh.uv()[:, 0] == 0, mesh.uv()[:, 0] == 1

    np.testing.assert_array_equal(mesh.positions[first], mesh.positions[last])
    np.testing.assert_array_equal(mesh.uv()[first, 1], mesh.uv()[last, 1])


def test_capped_can_is_closed() -> None:
    n, radius, height = 24, 0.5, 3.0
    mesh = made(type="cylinder", segments=n, radius=radius, height=height, caps=True)

    base = n / 2 * radius**2 * math.sin(2 * math.pi / n)

    assert volume(mesh) == pytest.approx(base * height, rel=1e-14)


def test_sphere_is_the_books_with_u_turned_round() -> None:
    # T14: theta = pi/3, phi = pi/4 give P = (.353553391, .707106781, .612372436); u = 1 - theta/2pi
    mesh = made(type="sphere", segments=12, rings=8)

    vertex = np.argmin(np.abs(mesh.uv() - [1 - 1 / 6, 3 / 4]).sum(axis=1))

    np.testing.assert_allclose(
        mesh.positions[vertex], [0.353553391, 0.707106781, 0.612372436], atol=1e-9
    )


def test_sphere_converges_to_a_ball() -> None:
    # A mesh of chords of angle d loses O(d^2): here d = 2 pi / 512, so about 1e-4.
    mesh = made(type="sphere", radius=2.0, segments=512, rings=256)

    assert area(mesh) == pytest.approx(16 * math.pi, rel=1e-4)
    assert volume(mesh) == pytest.approx(32 * math.pi / 3, rel=2e-4)
    np.testing.assert_allclose(np.linalg.norm(mesh.positions, axis=1), 2, rtol=1e-15)


def test_torus_converges_to_pappus() -> None:
    mesh = made(type="torus", radius=2.0, tube_radius=0.5, segments=512, rings=256)

    assert area(mesh) == pytest.approx(4 * math.pi**2 * 2.0 * 0.5, rel=1e-4)
    assert volume(mesh) == pytest.approx(2 * math.pi**2 * 2.0 * 0.25, rel=2e-4)
    np.testing.assert_allclose(
        np.hypot(np.hypot(mesh.positions[:, 0], mesh.positions[:, 2]) - 2, mesh.positions[:, 1]),
        0.5,
        rtol=1e-14,
    )


def test_box_shows_the_whole_texture_on_each_face() -> None:
    mesh = made(type="box", width=1.0, height=2.0, depth=3.0)

    assert volume(mesh) == pytest.approx(6, rel=1e-15)
    assert area(mesh) == pytest.approx(2 * (2 + 3 + 6), rel=1e-15)
    np.testing.assert_array_equal(uv_areas(mesh), np.full(12, 0.5))
    assert len(np.unique(mesh.normals, axis=0)) == 6


@pytest.mark.parametrize(
    ("facing", "right", "up"), [("+z", (1, 0, 0), (0, 1, 0)), ("+y", (1, 0, 0), (0, 0, -1))]
)
@pytest.mark.parametrize("kind", ["plane", "disk"])
def test_flat_shapes_have_u_to_the_right_and_v_up(
    kind: str, facing: str, right: tuple[int, ...], up: tuple[int, ...]
) -> None:
    mesh = made(type=kind, facing=facing)

    # Half the size 2 of both shapes is 1, so position = (2u - 1) right + (2v - 1) up.
    expected = (2 * mesh.uv() - 1) @ np.array([right, up])

    np.testing.assert_allclose(mesh.positions, expected, atol=1e-15)
