"""Where on the tile each texel is."""

import numpy as np
import pytest


@pytest.mark.parametrize(
    ("along", "expected"),
    [
        ("u", [[1, 3, 5, 7], [1, 3, 5, 7]]),
        ("v", [[6, 6, 6, 6], [2, 2, 2, 2]]),
    ],
)
def test_it_is_the_middle_of_each_texel(make, along, expected):
    pixels = make({"technique": "gradient", "along": along}, (4, 2))
    np.testing.assert_array_equal(pixels[..., 0], np.array(expected) / 8)


def test_the_radius_is_1_at_the_edge(make):
    pixels = make({"technique": "gradient", "along": "radius"}, (3, 3))[..., 0]
    assert pixels[1, 1] == 0
    assert pixels[1, 2] == pytest.approx(2 / 3)
    assert pixels[0, 0] == pytest.approx(np.sqrt(8) / 3)
    assert make({"technique": "gradient", "along": "radius"}, (99, 99)).max() == 1


def test_the_angle_is_counted_from_the_right_and_counter_clockwise(make):
    pixels = make({"technique": "gradient", "along": "angle"}, (3, 3))[..., 0]
    around = [pixels[1, 2], pixels[0, 2], pixels[0, 1], pixels[1, 0], pixels[2, 1]]
    np.testing.assert_allclose(around, [0, 1 / 8, 1 / 4, 1 / 2, 3 / 4], atol=1e-7)
