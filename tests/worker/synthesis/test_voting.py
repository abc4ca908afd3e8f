"""From patches to pixels: which of the proposed source pixels one becomes."""

import numpy as np
import pytest

from worker.synthesis.by_example.patch_grid import PatchGrid
from worker.synthesis.by_example.voting import vote


def chosen(proposals, costs, fixed=False, alike=0):
    """What the middle pixel becomes, which all patches of a row hold and propose these greys for.

    Each proposal is a source pixel of its own, but the first one is that of `alike` more patches.
    """
    side = len(costs)
    grid = PatchGrid((side, 2 * side - 1), side, 1, wraps=False)
    groups = [0] * alike + list(range(len(proposals)))
    wholes = [groups[patch] * 2 * side + side - 1 for patch in range(side)]
    columns = np.array([[whole - (side - 1 - patch) for patch, whole in enumerate(wholes)]])
    source = np.full((side, 2 * side * len(proposals) + side, 1), 200, np.uint8)
    for patch, whole in enumerate(wholes):
        source[:, whole] = proposals[groups[patch]]
    field = (np.zeros((1, side), np.int32), columns.astype(np.int32), np.array([costs], np.int32))
    made = np.full((side, 2 * side - 1, 1), 7, np.uint8)
    place = np.full((*made.shape[:2], 2), -1, np.int32)
    mask, all_new = np.full(made.shape[:2], fixed), np.ones((1, side), bool)
    changed = vote(source, field, (grid.cover(0), grid.cover(1)), made, place, mask, all_new)
    middle = side // 2, side - 1
    return made[(*middle, 0)], place[middle].tolist(), bool(changed[middle])


@pytest.mark.parametrize("greys", [(0, 100, 110), (110, 0, 100), (100, 110, 0)])
def test_of_patches_that_fit_equally_the_pixel_nearest_their_mean_is_taken(greys):
    # The mean is 70: neither the first, nor the darkest or lightest
    grey, place, changed = chosen(greys, (50, 50, 50))

    assert grey == 100
    assert place == [1, 6 * greys.index(100) + 2]
    assert changed


@pytest.mark.parametrize("exact", range(3))
def test_a_patch_that_fits_exactly_outweighs_two_that_do_not(exact):
    # Weights are one over the root of cost + 1: 1 beside 0.1 and 0.1, so the mean is near to 0
    greys = [100, 100, 100]
    greys[exact] = 0

    grey, *_ = chosen(greys, [0 if patch == exact else 99 for patch in range(3)])

    assert grey == 0


def test_what_two_patches_propose_is_preferred_to_what_is_a_little_nearer():
    # The mean of 0, 0, 78 and 82 is 40: 78 is 38 away, and 0 is 40
    grey, *_ = chosen((0, 78, 82), (50, 50, 50, 50), alike=1)

    assert grey == 0
    assert chosen((0, 74, 86), (50, 50, 50, 50), alike=1)[0] == 74


def test_what_is_fixed_neither_changes_nor_moves():
    assert chosen((0, 100, 110), (50, 50, 50), fixed=True) == (7, [-1, -1], False)
