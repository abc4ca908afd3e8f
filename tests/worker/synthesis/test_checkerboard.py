"""The checkerboard against the closed forms of T39."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from worker.synthesis.checkerboard import _mean_signs

LIGHT, DARK = [0.85, 0.4, 0.0], [0.15, 0.4, 7.0]


def board(cells, colors=(LIGHT, DARK)):
    return {"technique": "checkerboard", "cells": list(cells), "colors": list(colors)}


def test_the_lower_left_square_has_the_first_colour(make):
    pixels = make(board((2, 2)), (4, 4))

    light, dark = np.float32(LIGHT), np.float32(DARK)
    assert (pixels[2:, :2] == light).all()
    assert (pixels[:2, 2:] == light).all()
    assert (pixels[:2, :2] == dark).all()
    assert (pixels[2:, 2:] == dark).all()


def test_squares_of_whole_pixels_have_pure_colours(make):
    pixels = make(board((6, 5)), (60, 35))

    columns, rows = np.meshgrid(np.arange(60) // 10, np.arange(34, -1, -1) // 7)
    expected = np.where((columns + rows)[..., np.newaxis] % 2 == 0, LIGHT, DARK)
    assert (pixels == expected.astype(np.float32)).all()


@pytest.mark.parametrize(
    ("cells", "pixels", "index", "mean"),
    [
        (7, 5, 0, 3 / 7),  # [0, 1.4]: 1 of light less .4 of dark, over 1.4
        (5, 4, 1, -1 / 5),  # [1.25, 2.5]: .5 of light less .75 of dark, over 1.25
        (2, 1, 0, 0.0),
        (3, 1, 0, 1 / 3),
        (1, 3, 2, 1.0),
    ],
)
def test_the_mean_sign_over_a_pixel_is_the_difference_of_the_areas(cells, pixels, index, mean):
    assert _mean_signs(cells, pixels)[index] == pytest.approx(mean, abs=1e-15)


def triangle(x):
    return 1 - abs(1 - x % 2)


@given(st.integers(1, 50), st.integers(1, 50))
def test_the_mean_over_a_pixel_is_the_difference_of_the_triangle_wave(cells, pixels):
    edges = np.arange(pixels + 1) * cells / pixels

    expected = np.diff(triangle(edges)) / np.diff(edges)
    assert _mean_signs(cells, pixels) == pytest.approx(expected, abs=1e-12)


@given(
    st.tuples(st.integers(1, 12), st.integers(1, 12)),
    st.tuples(st.integers(1, 9), st.integers(1, 9)),
)
def test_a_pixel_is_the_mean_of_the_board_over_its_area(cells, size):
    # A grid of width * nu parts per tile has a whole number of parts in every pixel and square
    parts_u = (np.arange(size[0] * cells[0]) // size[0]) % 2
    parts_v = (np.arange(size[1] * cells[1]) // size[1])[::-1] % 2
    dark = (parts_v[:, np.newaxis] + parts_u) % 2
    share = dark.reshape(size[1], cells[1], size[0], cells[0]).mean(axis=(1, 3))

    signs = np.multiply.outer(_mean_signs(cells[1], size[1])[::-1], _mean_signs(cells[0], size[0]))

    assert (1 - signs) / 2 == pytest.approx(share, abs=1e-12)


def test_many_squares_in_a_pixel_give_the_mean_colour(make):
    pixels = make(board((4096, 4096)), (2, 2))

    assert pixels == pytest.approx(np.broadcast_to(np.mean([LIGHT, DARK], axis=0), (2, 2, 3)))


def test_equal_colours_give_that_colour_exactly(make):
    pixels = make(board((7, 3), (LIGHT, LIGHT)), (32, 19))

    assert (pixels == np.float32(LIGHT)).all()


def test_the_mean_of_the_picture_does_not_depend_on_its_size(make):
    means = [
        make(board((8, 6)), size).mean(axis=(0, 1), dtype=np.float64)
        for size in [(1, 1), (17, 5), (64, 64), (100, 333)]
    ]

    # Float32 rounds each pixel to 2^-24 of values up to 7
    for mean in means:
        assert mean == pytest.approx(np.mean([LIGHT, DARK], axis=0), abs=1e-6)
