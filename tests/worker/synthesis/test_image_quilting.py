"""Quilting: X10."""

import itertools

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from tests.growing import grow as grow_by
from tests.growing import noise, sources
from worker.synthesis.image_quilting import cut


def grow(exemplar, size, **fields):
    return grow_by("image_quilting", exemplar, size, **fields)


@pytest.mark.parametrize("shape", [(40, 40), (1, 1), (2, 9), (30, 50)])
@pytest.mark.parametrize("size", [(70, 53), (1, 1), (4, 90)])
def test_every_pixel_is_one_of_the_exemplars_at_the_place_it_says(shape, size):
    exemplar = noise(*shape)

    made = grow(exemplar, size, block=20)

    assert made.image.pixels.shape == (size[1], size[0], 3)
    assert made.image.pixels.tobytes() == exemplar[sources(made, exemplar)].tobytes()


@given(st.lists(st.lists(st.integers(0, 50), min_size=3, max_size=3), min_size=1, max_size=5))
def test_a_cut_costs_least_of_all_paths(rows):
    differences = np.array(rows)

    path = cut(differences)

    def cost(columns):
        return sum(differences[row, column] for row, column in enumerate(columns))

    paths = [
        columns
        for columns in itertools.product(range(3), repeat=len(rows))
        if all(abs(a - b) <= 1 for a, b in itertools.pairwise(columns))
    ]
    assert (np.abs(np.diff(path)) <= 1).all()
    assert cost(path) == min(map(cost, paths))


def test_a_periodic_texture_goes_on_exactly():
    tile = np.random.default_rng(1).random((4, 5, 3), np.float32)

    pixels = grow(np.tile(tile, (8, 8, 1)), (90, 70), block=15, overlap=0.4).image.pixels

    assert (pixels[4:] == pixels[:-4]).all()
    assert (pixels[:, 5:] == pixels[:, :-5]).all()


def test_the_first_square_is_copied_whole():
    exemplar = noise(40, 40)

    rows, columns = sources(grow(exemplar, (60, 60), block=12, overlap=0.25), exemplar)

    # Up to where the next ones may begin to lie over it
    assert (np.diff(rows[:9, :9], axis=0) == 1).all()
    assert (np.diff(columns[:9, :9], axis=1) == 1).all()


def test_what_has_no_alpha_is_never_copied():
    exemplar = np.concatenate([noise(40, 40), np.ones((40, 40, 1), np.float32)], axis=-1)
    exemplar[18:22, :30] = 0

    assert (grow(exemplar, (80, 80), block=16).image.pixels[..., 3] == 1).all()


def test_a_constant_stays_constant():
    assert (grow(np.full((9, 9, 3), 0.25), (30, 20)).image.pixels == np.float32(0.25)).all()


def test_bits_do_not_depend_on_threads(with_threads):
    exemplar = noise(60, 60)

    one, two = (with_threads(n, lambda: grow(exemplar, (150, 150)).image.pixels) for n in (1, 2))

    assert one.tobytes() == two.tobytes()
