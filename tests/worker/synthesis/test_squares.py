"""Lobes added up for squares of pixels (T35): never worse than for each pixel by itself."""

import numpy as np
import pytest

from worker.synthesis import _pieces, _squares
from worker.synthesis._cube import face_directions
from worker.synthesis._lobes import ggx, phong

SUN = np.array([0.36, 0.48, 0.8])


def sunny(side):
    towards = face_directions(side)
    light = 0.5 + 0.5 * towards[..., 1] + 500.0 * (towards @ SUN > 0.997)
    return _pieces.pieces(np.repeat(light[..., None], 3, axis=-1).astype(np.float32))


def picture(height, width):
    """Directions of pixels round a place, 0.02 radians apart."""
    x, y = np.meshgrid(0.02 * np.arange(width), 0.02 * np.arange(height))
    way = np.array([0.2, 0.5, 0.8]) + x[..., None] * [1, 0, 0] + y[..., None] * [0, -1, 0.5]
    return way / np.linalg.norm(way, axis=-1, keepdims=True)


@pytest.mark.parametrize("lobe", [ggx(0.2), ggx(0.5), ggx(1.0), phong(0), phong(1), phong(40)])
@pytest.mark.parametrize("size", [(8, 12), (5, 3), (1, 1), (9, 4)])
def test_squares_are_as_near_to_the_sum_as_pixels_are(lobe, size):
    light = sunny(64)
    directions = picture(*size)
    flat = directions.reshape(-1, 3)

    together = _squares.sums(light, lobe, directions).reshape(-1, 3)

    exact = _pieces.sums(light, lobe, flat, _pieces.EVERY_TEXEL)
    alone = np.abs(_pieces.sums(light, lobe, flat) - exact)
    # Pieces of squares are those of pixels or smaller ones: half a percent for chance
    assert np.abs(together - exact).max() < alone.max() + 5e-3 * exact.mean()
    np.testing.assert_allclose(together, exact, rtol=0.03, atol=0.02 * exact.mean())


def test_directions_far_apart_are_added_up_each_by_itself():
    light = sunny(32)
    directions = np.random.default_rng(3).normal(size=(4, 4, 3))
    directions /= np.linalg.norm(directions, axis=-1, keepdims=True)

    together = _squares.sums(light, ggx(0.3), directions)

    alone = _pieces.sums(light, ggx(0.3), directions.reshape(-1, 3))
    np.testing.assert_array_equal(together.reshape(-1, 3), alone)


def test_opposite_directions_have_no_middle_and_are_still_added_up():
    light = sunny(16)
    directions = np.array([[[0.0, 0, 1], [0, 0, -1]], [[0, 0, -1], [0, 0, 1]]])

    together = _squares.sums(light, ggx(0.6), directions)

    assert np.isfinite(together).all()
    np.testing.assert_array_equal(together[0, 0], together[1, 1])


def test_a_constant_sky_is_constant():
    light = _pieces.pieces(np.full((6, 32, 32, 3), [0.25, 1.0, 4.0], np.float32))

    for lobe in (ggx(0.2), ggx(1.0), phong(7)):
        shown = _squares.sums(light, lobe, picture(6, 7))
        np.testing.assert_allclose(shown, np.broadcast_to([0.25, 1, 4], shown.shape), rtol=2e-6)
