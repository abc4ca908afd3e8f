import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from worker.models.vertices import flat_normals, normalised, number_rows, smooth_normals

CUBE = np.array([(x, y, z) for x in (-1.0, 1.0) for y in (-1.0, 1.0) for z in (-1.0, 1.0)])


@given(st.lists(st.tuples(st.integers(-3, 3), st.integers(-3, 3)), max_size=60))
def test_equal_rows_have_one_number_in_the_order_of_appearance(rows: list[tuple[int, int]]) -> None:
    seen = list(dict.fromkeys(rows))

    numbers, firsts = number_rows(np.array(rows, np.int64).reshape(-1, 2))

    assert numbers.tolist() == [seen.index(row) for row in rows]
    assert firsts.tolist() == [rows.index(row) for row in seen]


def test_corners_of_a_cube_point_along_its_diagonals_however_its_faces_are_split() -> None:
    """Three angles of 90 degrees meet at each corner; weights of area would tilt it."""
    quads = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    triangles = np.array([t for a, b, c, d in quads for t in ((a, b, c), (a, c, d))])

    normals = smooth_normals(CUBE, triangles, triangles, 8)

    np.testing.assert_allclose(normals, CUBE / np.sqrt(3), atol=1e-15)


def test_triangles_without_area_have_no_share_and_a_vertex_of_nothing_else_points_up_z() -> None:
    positions = np.array([(0.0, 0, 0), (1, 0, 0), (0, 0, -1), (5, 5, 5)])
    triangles = np.array([(0, 1, 2), (0, 0, 1), (3, 3, 3)])

    normals = smooth_normals(positions, triangles, triangles, 4)

    np.testing.assert_allclose(normals, [(0, 1, 0)] * 3 + [(0, 0, 1)], atol=1e-15)


def test_normals_of_tiny_and_of_huge_triangles_are_unit() -> None:
    corner = np.array([(0.0, 0, 0), (1, 0, 0), (0, 1, 0)])

    normals = flat_normals(np.stack([corner * 1e-30, corner * 1e9, corner * 0]))

    assert normals.tolist() == [[0, 0, 1]] * 3


def test_vectors_that_are_no_numbers_become_unit_ones() -> None:
    vectors = np.array([(3.0, 0, 4), (np.nan, 0, 0), (np.inf, 1, 1), (0, 0, 0), (0, 1e-300, 0)])

    np.testing.assert_allclose(
        normalised(vectors), [(0.6, 0, 0.8), (0, 0, 1), (0, 0, 1), (0, 0, 1), (0, 1, 0)]
    )
