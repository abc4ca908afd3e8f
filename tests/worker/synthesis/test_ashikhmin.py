"""Ashikhmin's pieces: T55, T56, T57 and case A21 of the reference."""

import numpy as np
import pytest

from tests.growing import colours, noise, sources
from tests.growing import grow as grow_by


def grow(exemplar, size, **fields):
    return grow_by("ashikhmin", exemplar, size, **fields)


def test_a21_pixels_come_from_the_source_and_fixed_ones_stay():
    exemplar, keep = noise(16, 16), noise(48, 48, seed=1)
    mask = np.zeros((48, 48, 1), np.float32)
    mask[20:25, 30:35] = 1

    made = grow(exemplar, (48, 48), keep=keep, keep_mask=mask, seed=7)
    again = grow(exemplar, (48, 48), keep=keep, keep_mask=mask, seed=7)

    pixels, stays = made.image.pixels, mask[..., 0] > 0
    assert pixels[stays].tobytes() == keep[stays].tobytes()
    assert colours(pixels[~stays]) <= colours(exemplar)
    rows, columns = (part[~stays] for part in sources(made, exemplar))
    assert pixels[~stays].tobytes() == exemplar[rows, columns].tobytes()
    assert pixels.tobytes() == again.image.pixels.tobytes()
    assert (pixels != grow(exemplar, (48, 48), seed=8).image.pixels).any()


@pytest.mark.parametrize("passes", [1, 2, 5])
@pytest.mark.parametrize("neighbourhood", [[1, 1], [2, 1], [1, 2], [3, 3]])
def test_pieces_are_coherent(passes, neighbourhood):
    # By chance a pixel of 32 x 32 would continue its left or upper neighbour twice in a thousand
    made = grow(noise(32, 32), (64, 64), passes=passes, neighbourhood=neighbourhood)

    assert made.report["quality"]["coherent"] > 0.5


@pytest.mark.parametrize("shape", [(1, 1), (1, 9), (2, 3), (5, 5)])
def test_an_exemplar_smaller_than_the_neighbourhood_is_compared_with_less(shape):
    exemplar = noise(*shape)

    made = grow(exemplar, (20, 15), neighbourhood=[4, 4])

    assert made.image.pixels.tobytes() == exemplar[sources(made, exemplar)].tobytes()


def test_a_constant_stays_constant():
    assert (grow(np.full((9, 9, 3), 0.25), (30, 20)).image.pixels == np.float32(0.25)).all()


def test_vertical_stripes_stay_vertical_stripes():
    stripes = np.tile(np.linspace(0, 1, 4, dtype=np.float32)[None, :, None], (24, 6, 3))

    pixels = grow(stripes, (32, 32), neighbourhood=[4, 2], passes=4).image.pixels

    # Every pixel but those along a few faults is followed by the next stripe
    steps = np.diff(np.rint(pixels[..., 0] * 3), axis=1) % 4
    assert (steps == 1).mean() > 0.9


def test_what_has_no_alpha_is_never_copied():
    exemplar = np.concatenate([noise(24, 24), np.ones((24, 24, 1), np.float32)], axis=-1)
    exemplar[8:12, :20] = 0

    assert (grow(exemplar, (48, 48)).image.pixels[..., 3] == 1).all()


def test_a_guide_decides_where_what_goes():
    exemplar = noise(32, 64) * 0.4
    exemplar[:, 32:] += 0.6
    guide = np.zeros((48, 48, 1), np.float32)
    guide[:, :24] = 1

    bright = grow(exemplar, (48, 48), guide=guide).image.pixels.mean(axis=-1) > 0.5

    wanted = guide[..., 0] > 0
    assert (bright & wanted).sum() / (bright | wanted).sum() > 0.9


def test_it_goes_on_around_its_edges():
    rows, columns = np.indices((40, 40))
    exemplar = (0.5 + 0.4 * np.sin(rows / 3.3) * np.cos(columns / 4.1))[..., np.newaxis]

    made = grow(exemplar, (64, 48), neighbourhood=[3, 3])

    assert made.report["quality"]["seam"] <= 1
