"""From patches to pixels: which of the proposed source pixels one becomes."""

import numpy as np
import pytest

from worker.synthesis.by_example.patch_grid import PatchGrid
from worker.synthesis.by_example.voting import vote

SIDE = 3


def chosen(proposals, costs, fixed=False):
    """What the middle of 3 x 5 pixels becomes, whose three patches propose these greys.

    Each is of a column of its own of the source, three apart.
    """
    grid = PatchGrid((SIDE, 5), SIDE, 1, wraps=False)
    source = np.full((SIDE, 9, 1), 200, np.uint8)
    columns = np.arange(3) * 3
    for patch, grey in enumerate(proposals):
        source[:, columns[patch] + 2 - patch] = grey
    field = (np.zeros((1, 3), np.int32), columns[np.newaxis].astype(np.int32),
             np.array([costs], np.int32))  # fmt: skip
    made = np.full((SIDE, 5, 1), 7, np.uint8)
    place = np.full((SIDE, 5, 2), -1, np.int32)
    mask = np.full((SIDE, 5), fixed)
    changed = vote(source, field, (grid.cover(0), grid.cover(1)), made, place, mask,
                   np.ones((1, 3), bool))  # fmt: skip
    return made[1, 2, 0], place[1, 2].tolist(), bool(changed[1, 2])


@pytest.mark.parametrize("greys", [(0, 100, 110), (110, 0, 100), (100, 110, 0)])
def test_of_patches_that_fit_equally_the_pixel_nearest_their_mean_is_taken(greys):
    # The mean is 70: neither the first, nor the darkest or lightest
    grey, place, changed = chosen(greys, (50, 50, 50))

    assert grey == 100
    patch = greys.index(100)
    assert place == [1, 3 * patch + 2 - patch]
    assert changed


@pytest.mark.parametrize("exact", range(3))
def test_a_patch_that_fits_exactly_outweighs_two_that_do_not(exact):
    # Weights are one over the root of cost + 1: 1 beside 0.1 and 0.1, so the mean is near to 0
    greys = [100, 100, 100]
    greys[exact] = 0

    grey, *_ = chosen(greys, [0 if patch == exact else 99 for patch in range(3)])

    assert grey == 0


def test_what_is_fixed_neither_changes_nor_moves():
    assert chosen((0, 100, 110), (50, 50, 50), fixed=True) == (7, [-1, -1], False)
