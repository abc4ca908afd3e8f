"""Sliced Wasserstein distances of patches (Rabin et al., 2012)."""

import numpy as np
import pytest

from tests.growing import grow, noise
from worker.synthesis.by_example.wasserstein import moved, sliced_wasserstein


def everything(features):
    return np.ones(features.shape[:2], bool)


def distance(ours, theirs, side=9):
    return sliced_wasserstein(ours, everything(ours), theirs, everything(theirs), side)


def test_along_a_line_it_is_the_area_between_the_distributions():
    # 0, 1, 4 and 2, 2, 2: in order 2 + 1 + 2 steps for 3 points
    first, second = np.array([[4.0], [0.0], [1.0]]), np.array([[2.0], [2.0], [2.0]])

    assert moved(first, second, np.ones((1, 1))) == pytest.approx(5 / 3)


def test_a_cloud_that_was_shifted_is_as_far_away_as_it_was_shifted():
    cloud = np.random.default_rng(1).normal(size=(50, 2))
    lines = np.array([[1.0, 0.0, 0.6], [0.0, 1.0, 0.8]])

    # |3|, |4| and |0.6 x 3 + 0.8 x 4| = 5
    assert moved(cloud, cloud + np.array([3, 4]), lines) == pytest.approx(4)


def test_equal_pictures_are_not_apart_and_it_is_symmetric():
    first, second = (
        np.random.default_rng(seed).integers(0, 256, (30, 40, 3)).astype(np.uint8)
        for seed in (1, 2)
    )

    assert distance(first, first) == 0
    assert distance(first, second) == distance(second, first) > 0


def test_black_and_white_are_about_one_apart():
    black = np.zeros((20, 20, 1), np.uint8)

    # The mean of |sum of the 81 numbers of a random line of length 1|: sqrt(2 / pi) = 0.80, of
    # 32 lines within +- 3 x 0.6 / sqrt(32)
    assert distance(black, black + np.uint8(255)) == pytest.approx(0.8, abs=0.32)


def test_a_picture_without_a_whole_patch_has_no_distance():
    picture = np.zeros((20, 20, 1), np.uint8)

    assert distance(picture[:8], picture) is None
    assert sliced_wasserstein(picture, everything(picture), picture, picture[..., 0] > 0, 9) is None


def test_it_is_told_at_three_sizes():
    quality = grow("image_quilting", noise(160, 160), (160, 160)).report["quality"]

    assert 0 < quality["wasserstein_2"] < 0.2
    assert quality["wasserstein_4"] is not None
    assert quality["wasserstein_8"] is not None
