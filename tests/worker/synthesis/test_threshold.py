"""Masks: a step, a smooth step, and how much of a noise lies above a level."""

import numpy as np
import pytest

from worker.images.image import Image

ASSET = {"technique": "image", "asset": "0" * 64}


def cut(make, values, **fields):
    pixels = np.float32(values).reshape(1, -1, 1)
    body = {"technique": "threshold", "input": ASSET, **fields}
    return make(body, (pixels.shape[1], 1), lambda spec, meaning: Image(pixels, meaning))[0, :, 0]


def test_a_hard_edge_is_at_the_level_which_lies_above(make):
    found = cut(make, [-1, 0.2, 0.25, 0.3, np.inf, -np.inf, np.nan], level=0.25)

    assert found.tolist() == [0, 0, 1, 1, 1, 0, 0]


def test_a_soft_edge_is_a_smooth_step_around_the_level(make):
    found = cut(make, [0.4, 0.45, 0.5, 0.55, 0.6, 7], level=0.5, softness=0.2)

    # s = 0, 1/4, 1/2, 3/4, 1: s^2 (3 - 2 s)
    assert found == pytest.approx([0, 0.15625, 0.5, 0.84375, 1, 1], abs=1e-6)


def test_t44_as_much_of_a_sum_of_many_waves_lies_above_as_of_a_bell_curve(make):
    # A sum of n waves / n has variance 1 / (2 n); as numbers from 0 to 1, 1 / (8 n)
    waves, deviations = 64, 0.75
    level = 0.5 + deviations / np.sqrt(8 * waves)
    body = {"technique": "gardner", "count": waves, "frequency": 8, "bandwidth": 24, "seed": 5}

    mask = make({"technique": "threshold", "input": body, "level": level}, (512, 512))

    # 1 - Phi(.75) = .2266; a tile of some 1000 independent spots is off by sqrt(.2266 .7734 / 1000)
    assert mask.mean() == pytest.approx(0.2266, abs=3 * 0.0132)
