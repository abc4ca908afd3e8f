import numpy as np
import pytest

from api_schemas import meshes
from worker.geometry.primitives import build
from worker.rendering.draw_order import back_to_front, is_convex, nearness

TURN = np.linalg.qr(np.random.default_rng(1).normal(size=(3, 3)))[0]
TURN *= np.linalg.det(TURN)  # a turn, not a mirror


def test_what_is_nearer_counts_along_the_view_and_not_aside() -> None:
    eye = np.eye(4)
    eye[:3, 3] = [0, 0, 5]

    near = nearness(np.array([[9.0, 0, 4], [0, 0, 3], [0, 0, 6]]), eye)

    np.testing.assert_array_equal(near, [-1, -2, 1])


def test_triangles_come_farthest_first_and_equal_ones_keep_their_order() -> None:
    heights = np.array([3.0, 1.0, 2.0, 1.0])
    positions = np.repeat(heights, 3)[:, None] * [0.0, 0.0, 1.0] + np.tile(np.eye(3), (4, 1))
    triangles = np.arange(12, dtype=np.uint32).reshape(4, 3)

    ordered = back_to_front(positions, triangles, np.array([0.0, 0.0, 1.0]))
    turned = back_to_front(positions, triangles, np.array([0.0, 0.0, -1.0]))

    np.testing.assert_array_equal(ordered, triangles[[1, 3, 2, 0]])
    np.testing.assert_array_equal(turned, triangles[[0, 2, 1, 3]])


def test_lines_and_points_are_sorted_too() -> None:
    positions = np.array([[0.0, 0, 2], [0, 0, 3], [0, 0, 0], [0, 0, 1]])
    towards = np.array([0.0, 0.0, 1.0])

    lines = back_to_front(positions, np.array([[0, 1], [2, 3]], np.uint32), towards)
    points = back_to_front(positions, np.array([[0], [1], [2], [3]], np.uint32), towards)

    np.testing.assert_array_equal(lines, [[2, 3], [0, 1]])
    np.testing.assert_array_equal(points.ravel(), [2, 3, 0, 1])


@pytest.mark.parametrize(
    "shape",
    [
        meshes.Box(type="box", width=100.0, height=1.0, depth=0.01),
        meshes.Sphere(type="sphere", segments=24, rings=12),
        meshes.Cylinder(type="cylinder", segments=32),
        meshes.Cylinder(type="cylinder", segments=32, rows=4, caps=True),
        meshes.Plane(type="plane"),
        meshes.Disk(type="disk"),
    ],
    ids=lambda shape: shape.type,
)
def test_these_shapes_are_convex_wherever_they_stand(shape: meshes.Mesh) -> None:
    mesh = build(shape)

    # As OpenGL holds them: in float32, which leaves flat sides flat to 1e-7 of their distance.
    assert is_convex((mesh.positions @ TURN.T + 3).astype(np.float32), mesh.triangles)


def test_a_ring_is_not_convex_nor_is_a_shape_seen_from_inside() -> None:
    ring = build(meshes.Torus(type="torus", segments=24, rings=12))
    box = build(meshes.Box(type="box"))

    assert not is_convex(ring.positions, ring.triangles)
    assert not is_convex(box.positions, box.triangles[:, ::-1])


def test_two_convex_shapes_are_not_one() -> None:
    box = build(meshes.Box(type="box"))
    positions = np.concatenate([box.positions, box.positions + np.array([5.0, 0, 0])])
    triangles = np.concatenate([box.triangles, box.triangles + len(box.positions)])

    assert not is_convex(positions, triangles.astype(np.uint32))


def test_triangles_without_area_do_not_matter() -> None:
    box = build(meshes.Box(type="box"))
    flat = np.concatenate([box.triangles, [[0, 0, 1], [2, 2, 2]]]).astype(np.uint32)

    assert is_convex(box.positions, flat)
