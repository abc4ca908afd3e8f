"""Coordinates interpolated linearly on the screen, against barycentric ones worked out (T02)."""

import numpy as np
import pytest

from tests.worker.rendering.studio import Studio
from tests.worker.rendering.test_interpolation import FOV, SIDE, tilted, uv_as_color

pytestmark = pytest.mark.gl

CAMERA = {
    "type": "perspective",
    "fov_y": FOV,
    "pose": {"eye": [0.0, 0.0, 0.0], "target": [0.0, 0.0, -1.0]},
}
AFFINE = {"technique": "affine_uv"}
CORNERS = np.array([[0, 0], [1, 0], [0, 1], [1, 1]], dtype=np.float64)  # of the plane, as uv
TRIANGLES = [(0, 1, 2), (1, 3, 2)]


def seen(studio: Studio, matrix: np.ndarray, axis: int, coordinates: dict[str, str]) -> np.ndarray:
    surface = uv_as_color(studio, axis)
    color = {**surface["color"], "coordinates": coordinates}  # type: ignore[dict-item]
    node = {
        "mesh": {"type": "plane"},
        "transform": {"matrix": matrix.T.ravel().tolist()},
        "surface": {**surface, "color": color},
    }
    return studio.draw({"camera": CAMERA, "nodes": [node]}, (SIDE, SIDE))[..., 0]


def on_screen(matrix: np.ndarray) -> np.ndarray:
    """Where the corners are in pixels, from the left and from the top."""
    places = (matrix @ np.column_stack([2 * CORNERS - 1, np.zeros(4), np.ones(4)]).T).T[:, :3]
    slopes = places[:, :2] / -places[:, 2:] / np.tan(FOV / 2)
    return (slopes * [1, -1] + 1) / 2 * SIDE


def affine(matrix: np.ndarray, axis: int) -> np.ndarray:
    """Barycentric mixtures of the corners' coordinates; not a number outside."""
    row, column = np.mgrid[0:SIDE, 0:SIDE] + 0.5
    pixels = np.stack([column, row], axis=2)
    found = np.full((SIDE, SIDE), np.nan)
    corners = on_screen(matrix)
    for triangle in TRIANGLES:
        a, b, c = corners[list(triangle)]
        edges = np.stack([b - a, c - a], axis=1)
        share = (pixels - a) @ np.linalg.inv(edges).T
        weights = np.concatenate([1 - share.sum(axis=2, keepdims=True), share], axis=2)
        inside = (weights > 0.01).all(axis=2)
        found[inside] = (weights @ CORNERS[list(triangle), axis])[inside]
    return found


@pytest.mark.parametrize("axis", [0, 1], ids=["u", "v"])
def test_t02_affine_coordinates_are_mixtures_on_the_screen(studio: Studio, axis: int) -> None:
    matrix = tilted(-1.1, 0.5, np.array([0.2, -0.1, -2.5]))
    expected = affine(matrix, axis)
    inside = np.isfinite(expected)

    drawn = seen(studio, matrix, axis, AFFINE)

    assert inside.sum() > 3000
    # Corners are put on a grid of 1/256 pixel; edges are at least 50 pixels long.
    assert np.abs(drawn - expected)[inside].max() < 2e-4
    right = seen(studio, matrix, axis, {"technique": "uv"})
    assert np.abs(drawn - right)[inside].max() > 0.05


def test_t02_seen_from_straight_ahead_both_are_alike(studio: Studio) -> None:
    matrix = tilted(0.0, 0.0, np.array([0.0, 0.0, -2.5]))

    drawn = seen(studio, matrix, 0, AFFINE)

    np.testing.assert_allclose(drawn, seen(studio, matrix, 0, {"technique": "uv"}), atol=2e-6)


def test_each_set_of_coordinates_can_be_read(studio: Studio) -> None:
    matrix = tilted(-1.1, 0.5, np.array([0.2, -0.1, -2.5]))
    drawn = [seen(studio, matrix, 0, AFFINE | {"set": number}) for number in range(4)]

    # A plane has one set, which stands in for the others.
    assert all((other == drawn[0]).all() for other in drawn)
