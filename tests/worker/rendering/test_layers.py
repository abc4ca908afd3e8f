"""What is told of pixels beside their light, against rays met with planes, spheres and boxes."""

from typing import Any, get_args

import numpy as np
import pytest

from api_schemas.output import Layer
from tests.worker.rendering.studio import Studio

pytestmark = pytest.mark.gl

ALL = list(get_args(Layer))
FOV = 0.9
WHITE = {"technique": "unlit"}


def looking(eye: list[float], target: list[float], **camera: Any) -> dict[str, Any]:
    return {
        "type": "perspective",
        "fov_y": FOV,
        "pose": {"eye": eye, "target": target},
        **camera,
    }


def rays(eye: Any, target: Any, side: int) -> tuple[np.ndarray, np.ndarray]:
    """Unit vector of the view axis, and ways through the pixels' middles, one along the axis."""
    axis = np.subtract(target, eye) / np.linalg.norm(np.subtract(target, eye))
    right = np.cross(axis, [0, 1, 0])
    right /= np.linalg.norm(right)
    up = np.cross(right, axis)
    row, column = np.mgrid[0:side, 0:side] + 0.5
    slope = np.tan(FOV / 2)
    x, y = (2 * column / side - 1) * slope, (1 - 2 * row / side) * slope
    return axis, axis + x[..., None] * right + y[..., None] * up


def column_major(matrix: np.ndarray) -> list[float]:
    return list(map(float, matrix.T.ravel()))


def turned(x: float, y: float) -> np.ndarray:
    cx, sx, cy, sy = np.cos(x), np.sin(x), np.cos(y), np.sin(y)
    return np.array([[cy, 0, sy], [0, 1, 0], [-sy, 0, cy]]) @ np.array(
        [[1, 0, 0], [0, cx, -sx], [0, sx, cx]]
    )


@pytest.mark.parametrize("supersampling", [1, 4])
@pytest.mark.parametrize("kind", ["perspective", "orthographic"])
def test_a_plane_at_three_is_at_three_off_the_axis_too(
    studio: Studio, kind: str, supersampling: int
) -> None:
    camera = {"type": kind, "pose": {"eye": [0.3, -0.2, 3.0], "target": [0.3, -0.2, 0.0]}}
    wall = {"mesh": {"type": "plane", "width": 50.0, "height": 50.0}, "surface": WHITE}

    drawn = studio.layers({"camera": camera, "nodes": [wall]}, ["depth"], (64, 48), supersampling)

    assert (drawn["depth"] == 3).all()


def test_depth_is_along_the_view_axis_wherever_one_looks(studio: Studio) -> None:
    eye, target = np.array([2.0, 1.0, -3.0]), np.array([-1.0, 0.5, 4.0])
    axis, _ = rays(eye, target, 1)
    right = np.cross(axis, [0, 1, 0]) / np.linalg.norm(np.cross(axis, [0, 1, 0]))
    matrix = np.eye(4)
    matrix[:3, :3] = np.stack([right, np.cross(right, axis), -axis], axis=1)
    matrix[:3, 3] = eye + 3 * axis
    wall = {
        "mesh": {"type": "plane", "width": 20.0, "height": 20.0},
        "transform": {"matrix": column_major(matrix)},
        "surface": WHITE,
    }

    camera = looking(eye.tolist(), target.tolist())
    drawn = studio.layers({"camera": camera, "nodes": [wall]}, ["depth"])

    # Corners 10 away from the middle are rounded at 2^-24 of that.
    np.testing.assert_allclose(drawn["depth"], 3, atol=3e-6)


def test_a_tilted_plane(studio: Studio) -> None:
    eye, target, side = [1.0, 2.0, 3.0], [0.2, 0.1, 0.0], 100
    matrix = np.eye(4)
    matrix[:3, :3] = turned(-0.9, 0.4) * [0.9, 1.3, 1.0]
    matrix[:3, 3] = [0.1, -0.2, 0.3]
    a, b, p = matrix[:3, 0], matrix[:3, 1], matrix[:3, 3]
    _, ways = rays(eye, target, side)
    normal = np.cross(a, b) / np.linalg.norm(np.cross(a, b))
    depth = (p - eye) @ normal / (ways @ normal)
    place = eye + depth[..., None] * ways
    x, y = (place - p) @ a / (a @ a), (place - p) @ b / (b @ b)
    uv = np.stack([(x + 1) / 2, (y + 1) / 2], axis=2)

    drawn = studio.layers(
        {
            "camera": looking(eye, target),
            "nodes": [
                {
                    "mesh": {"type": "plane"},
                    "transform": {"matrix": column_major(matrix)},
                    "surface": WHITE,
                }
            ],
        },
        ALL,
        (side, side),
    )

    inside = (np.maximum(np.abs(x), np.abs(y)) < 0.98) & (depth > 0)
    assert 1000 < inside.sum() < side * side
    assert (drawn["object_id"][inside] == 1).all()
    for name, expected in (
        ("depth", depth[..., None]),
        ("position", place),
        ("normal", np.broadcast_to(normal, place.shape)),
        ("tangent", np.broadcast_to(a / np.linalg.norm(a), place.shape)),
        ("geometric_normal", np.broadcast_to(normal, place.shape)),
        ("uv", uv),
    ):
        np.testing.assert_allclose(drawn[name][inside], expected[inside], atol=1e-5, err_msg=name)


def test_a_ball(studio: Studio) -> None:
    eye, target, side = np.array([0.5, 0.4, 3.0]), [0.0, 0.0, 0.0], 150
    # Edges lie up to (pi / 1400)^2 / 2 = 2.5e-6 below the ball, facets twice that, and slanted rays
    # meet them by as much as 1 / slant later.
    ball = {"type": "sphere", "segments": 1400, "rings": 700}
    _, ways = rays(eye, target, side)
    half_b, c = ways @ eye, eye @ eye - 1
    squared = (ways * ways).sum(axis=2)
    root = half_b**2 - squared * c
    depth = (-half_b - np.sqrt(np.maximum(root, 0))) / squared
    place = eye + depth[..., None] * ways
    slant = -(place * ways).sum(axis=2) / np.sqrt(squared)
    inside = (root > 0) & (slant > 0.6)
    poles = np.hypot(place[..., 0], place[..., 2]) < 0.1

    drawn = studio.layers(
        {
            "camera": looking(eye.tolist(), target),
            "nodes": [{"mesh": ball, "surface": WHITE}],
        },
        ALL,
        (side, side),
    )

    assert inside.sum() > 2000
    np.testing.assert_allclose(drawn["position"][inside], place[inside], atol=1e-5)
    np.testing.assert_allclose(drawn["depth"][inside][..., 0], depth[inside], atol=1e-5)
    np.testing.assert_allclose(drawn["normal"][inside], place[inside], atol=1e-5)
    # A facet's normal is that of the ball somewhere on the facet, pi / 700 across.
    off = np.linalg.norm(drawn["geometric_normal"] - place, axis=2)
    assert 1e-5 < off[inside].max() < np.pi / 700
    longitude = np.arctan2(-place[..., 2], place[..., 0]) % (2 * np.pi) / (2 * np.pi)
    latitude = np.arcsin(np.clip(place[..., 1], -1, 1)) / np.pi + 0.5
    clear = inside & ~poles & (np.abs(longitude - 0.5) < 0.49)
    np.testing.assert_allclose(drawn["uv"][clear][:, 1], latitude[clear], atol=1e-5)
    np.testing.assert_allclose(drawn["uv"][clear][:, 0], longitude[clear], atol=1e-5)
    east = np.stack([place[..., 2], 0 * depth, -place[..., 0]], axis=2)
    east /= np.linalg.norm(east, axis=2, keepdims=True)
    off = np.linalg.norm(drawn["tangent"] - east, axis=2)
    assert off[inside & ~poles].max() < np.pi / 700  # the mean of the facets round a vertex


@pytest.mark.parametrize("scale", [[1, 1, 1], [-1, 1, 1], [1e-3, 1e-3, 1e-3]])
@pytest.mark.parametrize("inside", [False, True])
def test_flat_sides_of_a_box_face_the_eye(studio: Studio, inside: bool, scale: list[float]) -> None:
    turn = turned(0.5, 0.7)
    matrix = np.eye(4)
    matrix[:3, :3] = turn * scale * (20 if inside else 1)
    eye = np.array([0.3, 0.2, 4.0]) * abs(scale[0])
    camera = looking(eye.tolist(), [0.0, 0.0, 0.0], near=1e-4)

    drawn = studio.layers(
        {
            "camera": camera,
            "nodes": [
                {
                    "mesh": {"type": "box"},
                    "transform": {"matrix": column_major(matrix)},
                    "surface": WHITE,
                }
            ],
        },
        ["normal", "geometric_normal", "object_id"],
        (80, 80),
    )

    covered = drawn["object_id"][..., 0] == 1
    flat = drawn["geometric_normal"][covered]
    sides = np.concatenate([turn.T, -turn.T])
    nearest = sides[np.argmax(flat @ sides.T, axis=1)]
    np.testing.assert_allclose(flat, nearest, atol=1e-6)
    np.testing.assert_allclose(drawn["normal"][covered], flat, atol=1e-6)
    _, ways = rays(eye, [0, 0, 0], 80)
    assert ((flat * ways[covered]).sum(axis=1) < 0).all()
    assert len(np.unique(np.round(flat, 3), axis=0)) >= (2 if inside else 3)


def test_facets_are_flat(studio: Studio) -> None:
    ball = {"type": "sphere", "segments": 7, "rings": 5}
    turn = turned(0.4, 0.3)
    matrix = np.eye(4)
    matrix[:3, :3] = turn * [1.0, 2.0, 0.5]

    drawn = studio.layers(
        {
            "camera": looking([1.0, 2.0, 5.0], [0.0, 0.0, 0.0]),
            "nodes": [
                {"mesh": ball, "transform": {"matrix": column_major(matrix)}, "surface": WHITE}
            ],
        },
        ["position", "geometric_normal", "object_id"],
        (200, 200),
    )

    covered = drawn["object_id"][..., 0] == 1
    flat, place = drawn["geometric_normal"][covered], drawn["position"][covered]
    normals, facet = np.unique(np.round(flat, 5), axis=0, return_inverse=True)
    assert 10 < len(normals) <= 7 * 4 * 2
    for index, normal in enumerate(normals):
        heights = place[facet == index] @ normal
        assert np.ptp(heights) < 2e-5  # the normal was rounded to 1e-5
