"""Positions and coordinates on the screen, against rays met with planes."""

import numpy as np
import pytest

from tests.worker.rendering.studio import Studio

pytestmark = pytest.mark.gl

SIDE = 200
FOV = 0.9
RAMP = {"scale": [0.5, 0.5], "offset": [0.25, 0.25]}


def uv_as_color(studio: Studio, axis: int) -> dict[str, object]:
    """A surface that shows u or v: two texels 0 and 1, read between their centres."""
    texels = [[0, 1]] if axis == 0 else [[1], [0]]
    return {
        "technique": "unlit",
        "color": {
            "texture": studio.texture(texels),
            "filter": "bilinear",
            "wrap": ["clamp", "clamp"],
            "transform": RAMP,
        },
    }


def tilted(angle_x: float, angle_y: float, shift: np.ndarray) -> np.ndarray:
    cx, sx, cy, sy = np.cos(angle_x), np.sin(angle_x), np.cos(angle_y), np.sin(angle_y)
    matrix = np.eye(4)
    matrix[:3, :3] = np.array([[cy, 0, sy], [0, 1, 0], [-sy, 0, cy]]) @ np.array(
        [[1, 0, 0], [0, cx, -sx], [0, sx, cx]]
    )
    matrix[:3, 3] = shift
    return matrix


def rays(side: int) -> np.ndarray:
    """Directions through the pixels' middles, camera at the origin looking along -z."""
    row, column = np.mgrid[0:side, 0:side] + 0.5
    slope = np.tan(FOV / 2)
    return np.stack(
        [(2 * column / side - 1) * slope, (1 - 2 * row / side) * slope, -np.ones_like(row)], axis=2
    )


@pytest.mark.parametrize("axis", [0, 1], ids=["u", "v"])
@pytest.mark.parametrize("distance", [0.0, 1e5], ids=["at the origin", "far from it"])
def test_uv_is_perspective_correct(studio: Studio, axis: int, distance: float) -> None:
    # T02. A ray t d meets the plane through p with axes a, b where t d = p + x a + y b.
    away = np.array([distance, -distance, distance])
    matrix = tilted(-1.1, 0.5, np.array([0.2, -0.1, -2.5]))
    a, b, _, p = matrix[:3].T
    solved = np.linalg.solve(
        np.stack(
            [np.broadcast_to(a, (SIDE, SIDE, 3)), np.broadcast_to(b, (SIDE, SIDE, 3)), -rays(SIDE)],
            axis=3,
        ),
        np.broadcast_to(-p, (SIDE, SIDE, 3))[..., None],
    )[..., 0]
    expected = (solved[..., axis] + 1) / 2

    placed = matrix.copy()
    placed[:3, 3] += away
    drawn = studio.draw(
        {
            "camera": {
                "type": "perspective",
                "fov_y": FOV,
                "pose": {"eye": away.tolist(), "target": (away - [0, 0, 1]).tolist()},
            },
            "nodes": [
                {
                    "mesh": {"type": "plane"},
                    "transform": {"matrix": placed.T.ravel().tolist()},
                    "surface": uv_as_color(studio, axis),
                }
            ],
        },
        (SIDE, SIDE),
    )
    inside = (np.abs(solved[..., :2]) < 0.98).all(axis=2)

    assert inside.sum() > 3000
    # Corners are put on a grid of 1/256 pixel, up to 1/512 off along each axis.
    slope = np.hypot(*np.gradient(expected))
    error = np.abs(drawn[..., 0] - expected)[inside]
    assert (error <= slope[inside] * np.sqrt(2) / 512 + 2e-6).all()


def test_affine_interpolation_would_be_noticed(studio: Studio) -> None:
    matrix = tilted(-1.1, 0.0, np.array([0.0, 0.0, -2.5]))
    drawn = studio.draw(
        {
            "camera": {
                "type": "perspective",
                "fov_y": FOV,
                "pose": {"eye": [0.0, 0.0, 0.0], "target": [0.0, 0.0, -1.0]},
            },
            "nodes": [
                {
                    "mesh": {"type": "plane"},
                    "transform": {"matrix": matrix.T.ravel().tolist()},
                    "surface": uv_as_color(studio, 1),
                }
            ],
        },
        (SIDE, SIDE),
    )[:, SIDE // 2, 0]

    covered = drawn[drawn > 0]

    # The middle row of the quad on the screen is not its middle in v.
    assert abs(covered[len(covered) // 2] - 0.5) > 0.1


def test_what_is_nearer_hides_what_is_farther(studio: Studio) -> None:
    def sheet(z: float, color: list[float]) -> dict[str, object]:
        return {
            "mesh": {"type": "plane"},
            "transform": {"translation": [0.0, 0.0, z]},
            "surface": {"technique": "unlit", "color": color},
        }

    sheets = [sheet(-500.0, [1.0, 0.0, 0.0]), sheet(-500.01, [0.0, 1.0, 0.0])]
    for nodes in (sheets, sheets[::-1]):
        drawn = studio.draw(
            {
                "camera": {
                    "type": "perspective",
                    "fov_y": 0.003,
                    "near": 0.001,
                    "far": 1e6,
                    "pose": {"eye": [0.0, 0.0, 0.0], "target": [0.0, 0.0, -1.0]},
                },
                "nodes": nodes,
            }
        )
        np.testing.assert_array_equal(drawn[4:-4, 4:-4], np.full((24, 24, 4), [1, 0, 0, 1]))


def test_of_two_at_the_same_place_the_first_in_the_request_shows(studio: Studio) -> None:
    colors = [[float(i == k) for k in range(3)] for i in range(3)]
    nodes = [
        {"mesh": {"type": "plane"}, "surface": {"technique": "unlit", "color": color}}
        for color in colors
    ]

    drawn = studio.draw(
        {
            "camera": {"type": "orthographic", "pose": {"eye": [0.0, 0.0, 2.0]}},
            "nodes": nodes,
        }
    )

    np.testing.assert_array_equal(drawn[..., :3], np.broadcast_to(colors[0], (32, 32, 3)))


def test_children_move_with_their_parents(studio: Studio) -> None:
    leaf = {
        "mesh": {"type": "plane"},
        "surface": {"technique": "unlit"},
        "transform": {"translation": [1.0, 0.0, 0.0], "scale": [0.5, 0.5, 1.0]},
    }
    half = float(np.sqrt(0.5))
    turned = {"transform": {"rotation": [0.0, 0.0, half, half]}, "children": [leaf]}
    drawn = studio.draw(
        {
            "camera": {"type": "orthographic", "height": 4.0, "pose": {"eye": [0.0, 0.0, 2.0]}},
            "nodes": [{"transform": {"scale": [0.5, 1.0, 1.0]}, "children": [turned]}],
        },
        (80, 80),
    )

    rows, columns = np.nonzero(drawn[..., 3])
    # The quarter turn takes the leaf to (0, 1); its halves 0.5 become 0.25 along x, 0.5 along y.
    assert (columns.min(), columns.max()) == (35, 44)
    assert (rows.min(), rows.max()) == (10, 29)
