"""Seams that hide along edges: X11, Kwatra et al. (2003), equation 6."""

import itertools

import networkx
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from worker.images.image import Image
from worker.synthesis.by_example.exemplar import Exemplar
from worker.synthesis.by_example.sewing import Seams, sewn
from worker.synthesis.by_example.views import Views, square

STEPS = ((0, 1), (1, 0))


def seams_of(levels, side=8):
    """Seams of a picture, (height, width), of whole numbers from 0 to 255, both among them."""
    pixels = np.asarray(levels, np.float32)[..., np.newaxis] / np.float32(255)
    exemplar = Exemplar.of({"exemplar": Image(pixels, "data")})
    assert (exemplar.features[..., 0] == levels).all()
    return Seams.of(Views.of(exemplar, turns=False, flips=False), side)


def random_levels(seed, height, width):
    levels = np.random.default_rng(seed).integers(0, 256, (height, width))
    # So many of both that what data are compared by is the levels themselves
    levels[:2], levels[2:4] = 0, 255
    return levels


def pairs(height, width):
    for step in STEPS:
        for row, column in np.ndindex(height - step[0], width - step[1]):
            yield step, (row, column), (row + step[0], column + step[1])


@settings(max_examples=30, deadline=None)
@given(st.integers(0, 2**32 - 1), st.sampled_from(STEPS))
def test_x11_a_seam_costs_how_much_squares_differ_by_how_much_they_change(seed, step):
    levels = random_levels(seed, 12, 14)
    seams = seams_of(levels)
    a, b = np.random.default_rng(seed).integers(2, 9, (2, 2))
    s, t = (0, *a), (0, *(b + step))

    found = seams.seen(np.array([s]), np.array([t]), step)[0]

    apart = abs(levels[tuple(a)] - levels[tuple(b)])
    apart += abs(levels[tuple(a + step)] - levels[tuple(b + step)])
    change = 0
    for place in (a, a + step, b, b + step):
        change += abs(levels[tuple(place + step)] - levels[tuple(place - step)]) // 2
    assert found == seams.scale * apart // (8 + change)


@pytest.mark.parametrize("place", [3, 5, 8])
@pytest.mark.parametrize("turned", [False, True])
def test_x11_a_seam_runs_along_an_edge_that_both_squares_have(place, turned):
    # The squares differ by 20 everywhere, so that without its changes any seam is as good
    step = np.where(np.arange(12) < place, 40, 180) + np.zeros((12, 1), int)
    extremes = np.tile([0, 255], (12, 3))
    levels = np.concatenate([step, step + 20, extremes], axis=1)
    levels = levels.T if turned else levels
    seams = seams_of(levels, 12)
    old = square((0, 0, 0), 12)
    new = square((0, 12, 0) if turned else (0, 0, 12), 12)
    free = np.ones((12, 12), bool)
    (free.T if turned else free)[:, 0] = False
    (old.transpose(1, 0, 2) if turned else old)[:, -1, 0] = -1

    made = sewn(seams, old, new, free)

    fresh = made[..., 1 if turned else 2] >= 12
    assert ((fresh.T if turned else fresh) == (np.arange(12) >= place)).all()
    # 20 at both pixels; each of four changes by half of 140
    costs = seams.all_seen(made, np.ones((12, 12), bool))
    assert costs.sum() == 12 * (seams.scale * 40 // (8 + 4 * 70))


@settings(max_examples=25, deadline=None)
@given(st.integers(0, 2**32 - 1))
def test_x11_seams_of_a_square_over_another_cost_as_much_as_the_least_cut(seed):
    seams = seams_of(random_levels(seed, 30, 30))
    random = np.random.default_rng(seed)
    (top, left), (lower, right) = random.integers(1, 20, (2, 2))
    old, new = square((0, top, left), 8), square((0, lower, right), 8)
    stays, unknown = np.zeros((8, 8), bool), np.zeros((8, 8), bool)
    stays[0], stays[:, 0], unknown[-2:, 4:] = True, True, True
    before = np.where(unknown[..., np.newaxis], [-1, 0, 0], old)

    made = sewn(seams, before, new, ~stays)

    graph = networkx.Graph()
    for step, s, t in pairs(8, 8):
        first = seams.seen(old[s][np.newaxis], new[t][np.newaxis], step)[0]
        second = seams.seen(new[s][np.newaxis], old[t][np.newaxis], step)[0]
        # By the formula it is the same which of the two shows which
        assert first == second
        names = ["new" if unknown[at] else "old" if stays[at] else at for at in (s, t)]
        if names[0] != names[1]:
            known = graph.get_edge_data(*names, default={"capacity": 0})["capacity"]
            graph.add_edge(*names, capacity=int(first) + known)
    assert (made[stays] == old[stays]).all()
    assert (made[unknown] == new[unknown]).all()
    costs = seams.all_seen(made, np.ones((8, 8), bool))
    assert costs.sum() == networkx.minimum_cut_value(graph, "old", "new")


@settings(max_examples=25, deadline=None)
@given(st.integers(0, 2**32 - 1))
def test_x11_over_old_seams_it_is_the_best_of_all_choices(seed):
    random = np.random.default_rng(seed)
    # Dark above light: squares of either with a seam between them, and over it one of both
    levels = random_levels(seed, 30, 30)
    levels[:15] //= 6
    levels[15:] = 255 - levels[15:] // 6
    levels[0], levels[-1] = 0, 255
    seams = seams_of(levels)
    dark, light, new = (
        square((0, row, column), 5)
        for row, column in zip(
            (4, 22, random.integers(11, 15)), random.integers(1, 20, 3), strict=True
        )
    )
    old = np.where(np.arange(5)[:, np.newaxis, np.newaxis] < 2, dark, light)
    free = np.zeros((5, 5), bool)
    free[1:4, 1:4] = True

    made = sewn(seams, old, new, free)

    # Each pair's cost, old seams at most that of the two new ones in their place
    costs = []
    for step, s, t in pairs(5, 5):
        four = [
            int(seams.seen(a[s][np.newaxis], b[t][np.newaxis], step)[0])
            for a, b in itertools.product((old, new), repeat=2)
        ]
        costs.append((s, t, [min(four[0], four[1] + four[2]), *four[1:]]))

    def cost(fresh):
        return sum(four[2 * fresh[s] + fresh[t]] for s, t, four in costs)

    choices = []
    for some in itertools.product((0, 1), repeat=9):
        fresh = np.zeros((5, 5), int)
        fresh[1:4, 1:4] = np.reshape(some, (3, 3))
        choices.append(cost(fresh))
    fresh = (made == new).all(axis=-1).astype(int)
    assert cost(fresh) == min(choices)
