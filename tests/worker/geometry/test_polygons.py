import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from worker.errors import UnusableAssetError
from worker.geometry.polygons import CORNERS_MAX, triangulate


def split(points: list[tuple[float, float, float]]) -> np.ndarray:
    return triangulate(
        np.array(points, np.float64),
        np.arange(len(points), dtype=np.int32),
        np.array([0, len(points)]),
    )


def area(points: np.ndarray) -> float:
    """Signed, by the shoelace formula."""
    x, y = points[:, 0], points[:, 1]
    return float((x * np.roll(y, -1) - np.roll(x, -1) * y).sum() / 2)


def assert_tiles(points: list[tuple[float, float, float]]) -> None:
    """The triangles have the winding of the outline and exactly its area: nothing overlaps."""
    flat = np.array(points)[:, :2]
    triangles = split(points)
    areas = [area(flat[row]) for row in triangles]

    assert len(triangles) == len(points) - 2
    assert min(areas) >= -1e-12
    assert sum(areas) == pytest.approx(area(flat), rel=1e-12)


def test_a_convex_face_becomes_a_fan() -> None:
    square = [(0.0, 0.0, 0.0), (1.0, 0.0, 0.0), (1.0, 1.0, 0.0), (0.0, 1.0, 0.0)]

    assert split(square).tolist() == [[0, 1, 2], [0, 2, 3]]


def test_the_notch_of_an_arrow_stays_open() -> None:
    assert_tiles([(0.0, 0.0, 0.0), (2.0, -1.0, 0.0), (1.0, 0.0, 0.0), (2.0, 1.0, 0.0)])


def test_a_square_with_a_hole_bridged_by_two_equal_edges_keeps_the_hole() -> None:
    outer = [(0.0, 0.0, 0.0), (4.0, 0.0, 0.0), (4.0, 4.0, 0.0), (0.0, 4.0, 0.0)]
    inner = [(1.0, 1.0, 0.0), (1.0, 3.0, 0.0), (3.0, 3.0, 0.0), (3.0, 1.0, 0.0)]

    assert_tiles([*outer, outer[0], *inner, inner[0]])


@pytest.mark.parametrize("seed", range(60))
def test_holes_bridged_from_one_to_the_next_stay_open(seed: int) -> None:
    """A plate with a row of holes as one outline, which passes each bridge twice."""
    random = np.random.default_rng(seed)
    holes = []
    for number in range(random.integers(1, 6)):
        sides = random.integers(3, 10)
        angles = random.random() * 6 - 2 * np.pi * np.arange(sides) / sides
        ring = [(3 * number + 1.5 + math.cos(a), 2 + math.sin(a), 0.0) for a in angles]
        leftmost = ring.index(min(ring))
        holes.append(ring[leftmost:] + ring[:leftmost])

    def round_holes(number: int) -> list[tuple[float, float, float]]:
        path = []
        for corner in holes[number]:
            path.append(corner)
            if corner == max(holes[number]) and number + 1 < len(holes):
                path += [*round_holes(number + 1), corner]
        return [*path, holes[number][0]]

    width = 3.0 * len(holes)
    plate = [(0.0, 0.0, 0.0), (width, 0.0, 0.0), (width, 4.0, 0.0), (0.0, 4.0, 0.0)]
    assert_tiles([*plate, (0.0, 2.0, 0.0), *round_holes(0), (0.0, 2.0, 0.0)])


@given(st.lists(st.floats(0.2, 3.0), min_size=4, max_size=40))
def test_stars_are_tiled(radii: list[float]) -> None:
    step = 2 * math.pi / len(radii)
    assert_tiles([(r * math.cos(i * step), r * math.sin(i * step), 0) for i, r in enumerate(radii)])


@pytest.mark.parametrize("turned", [np.eye(3), np.eye(3)[[1, 2, 0]], np.eye(3)[[2, 0, 1]]])
@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_a_hollow_face_keeps_its_winding_in_every_plane(turned: np.ndarray, sign: float) -> None:
    arrow = np.array([(0.0, 0.0, 5.0), (2.0, -1.0, 5.0), (1.0, 0.0, 5.0), (2.0, 1.0, 5.0)])
    points = arrow * [1, sign, 1] @ turned

    corners = points[split([tuple(p) for p in points])]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])

    np.testing.assert_allclose(normals.sum(axis=0), sign * np.array([0, 0, 2.0]) @ turned)
    assert (normals @ (sign * np.array([0, 0, 1.0]) @ turned) > 0).all()


def test_a_bow_tie_and_a_face_without_area_are_split_somehow() -> None:
    assert len(split([(0, 0, 0), (1, 1, 0), (1, 0, 0), (0, 1, 0)])) == 2
    assert len(split([(0, 0, 0)] * 7)) == 5
    assert len(split([(float(i), 0, 0) for i in range(6)])) == 4


def test_a_face_of_ten_million_corners_is_refused() -> None:
    corners = np.zeros(10**7, np.int32)

    with pytest.raises(UnusableAssetError, match=f"the most is {CORNERS_MAX}") as refusal:
        triangulate(np.zeros((1, 3)), corners, np.array([0, 10**7]))
    assert refusal.value.code == "asset_too_large"


def test_a_scribble_that_would_take_minutes_is_refused() -> None:
    scribble = np.random.default_rng(1).random((20_000, 3)) * [1, 1, 0]

    with pytest.raises(UnusableAssetError) as refusal:
        triangulate(scribble, np.arange(20_000, dtype=np.int32), np.array([0, 20_000]))
    assert refusal.value.code == "asset_too_large"
