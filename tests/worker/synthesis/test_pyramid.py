"""Pictures at half their size, and what lies around a pixel: on a torus, or not."""

import numpy as np
import pytest

from worker.synthesis.by_example.pyramid import halved
from worker.synthesis.by_example.surroundings import known_around
from worker.synthesis.by_example.task import Task, levels


def picture(height, width):
    return np.random.default_rng(1).integers(0, 256, (height, width, 2)).astype(np.uint8)


@pytest.mark.parametrize("wraps", [True, False])
def test_on_a_torus_a_picture_may_be_moved_before_or_after_it_is_halved(wraps):
    whole, known = picture(12, 16), picture(12, 16)[..., 0] > 60

    half = halved(whole, known, wraps=wraps)
    moved = halved(*(np.roll(part, (2, 4), (0, 1)) for part in (whole, known)), wraps=wraps)

    same = [(np.roll(a, (1, 2), (0, 1)) == b).all() for a, b in zip(half, moved, strict=True)]
    assert all(same) == wraps


def test_a_pixel_of_half_the_size_is_the_mean_of_what_is_known():
    whole, known = np.zeros((4, 4, 1), np.uint8), np.zeros((4, 4), bool)
    whole[:, :2], whole[:, 2:] = 40, 200
    known[:, :2] = True

    half, found = halved(whole, known)

    assert half[..., 0].tolist() == [[40, 40], [40, 40]]
    assert found.tolist() == [[True, False], [True, False]]


@pytest.mark.parametrize(("wraps", "count"), [(True, 9), (False, 4)])
def test_around_a_corner_is_the_other_side_or_nothing(wraps, count):
    numbers = np.arange(20, dtype=np.uint8).reshape(4, 5, 1)
    weights = np.ones((3, 3), np.int32)

    steps, found, values = known_around(np.ones((4, 5), bool), numbers, weights, (0, 0), wraps)

    assert len(steps) == len(found) == count
    told = {tuple(step): value for step, value in zip(steps.tolist(), values[:, 0], strict=True)}
    assert told[1, 1] == 6
    if wraps:
        assert told[-1, -1] == 19
        assert told[-1, 0] == 15
        assert told[0, -1] == 4


def test_guides_are_there_on_every_level():
    everything = np.ones((96, 96), bool)
    grey, light = np.full((96, 96, 1), 40, np.uint8), np.full((96, 128, 1), 200, np.uint8)
    task = Task(picture(96, 96), everything, (96, 128), False, 0, guides=(grey, light))

    found = levels(task)

    assert len(found) == 3
    for level in found:
        assert (level.source[..., 2] == 40).all()
        assert (level.target[..., 2] == 200).all()
