"""Reliefs found again from their normals, and fields that no relief has (T66)."""

import numpy as np
import pytest

from worker.images.image import Image
from worker.synthesis.height_from_normal import integrated

ASSET = {"technique": "image", "asset": "0" * 64}


def centres(side):
    middle = (np.arange(side) + 0.5) / side
    return np.meshgrid(middle, 1 - middle)


def packed(slope_u, slope_v):
    normals = np.stack([-slope_u, -slope_v, np.ones_like(slope_u)], axis=-1)
    return normals / np.linalg.norm(normals, axis=-1, keepdims=True)


def heights(make, normals, **fields):
    body = {"technique": "height_from_normal", "normal": ASSET, **fields}
    size = normals.shape[1], normals.shape[0]
    picture = normals.astype(np.float32)
    return make(body, size, lambda spec, meaning: Image(picture, meaning))[..., 0]


def test_a_sine_is_found_from_its_exact_normals(make):
    u, v = centres(64)
    relief = 0.05 * np.sin(2 * np.pi * (u + 2 * v))
    slope = 0.05 * 2 * np.pi * np.cos(2 * np.pi * (u + 2 * v))
    normals = packed(slope, 2 * slope)

    found = heights(make, normals, normal_range="signed", range="signed", depth=1.0)
    centred = heights(make, normals / 2 + 0.5, depth=0.1)

    # Normals rounded to float32 have slopes off by some 1e-7
    assert found == pytest.approx(relief, abs=1e-7)
    assert centred == pytest.approx(0.5 + relief / 0.1, abs=1e-6)


def test_green_down_mirrors_the_slope_along_v(make):
    u, v = centres(32)
    normals = packed(np.zeros_like(u), np.cos(2 * np.pi * v))

    up = heights(make, normals, normal_range="signed", range="signed")
    down = heights(make, normals, normal_range="signed", range="signed", green="down")

    assert up.std() > 0.1
    assert (up == -down).all()


def test_t66_a_swirl_is_no_relief_and_a_relief_is_nothing_else():
    u, v = centres(256)
    # A14: orthogonal to the gradient of every relief
    swirl = integrated(0.3 * np.sin(2 * np.pi * v), -0.3 * np.sin(2 * np.pi * u))
    relief = integrated(np.cos(2 * np.pi * u), np.zeros_like(u))
    both = integrated(np.cos(2 * np.pi * u), np.cos(2 * np.pi * u))

    assert swirl[1] == pytest.approx(1, abs=1e-6)
    assert np.abs(swirl[0]).max() < 1e-12
    assert relief[1] == pytest.approx(0, abs=1e-12)
    # The slope along v has no part along k = (1, 0)
    assert both[1] == pytest.approx(0.5, abs=1e-12)


def test_t66_an_eight_bit_normal_map_gives_its_relief_within_its_rounding(make):
    u, v = centres(256)
    relief = 0.05 * np.sin(2 * np.pi * u) * np.sin(2 * np.pi * v)
    slope_u = 0.1 * np.pi * np.cos(2 * np.pi * u) * np.sin(2 * np.pi * v)
    slope_v = 0.1 * np.pi * np.sin(2 * np.pi * u) * np.cos(2 * np.pi * v)
    codes = np.round(255 * (packed(slope_u, slope_v) / 2 + 0.5)) / 255

    found = heights(make, codes, range="signed", depth=1.0)

    # Codes hold no 0: a bias of half a code is a mean slope, which no tile has
    error = np.sqrt(np.mean((found - relief) ** 2)) / np.sqrt(np.mean(relief**2))
    assert error < 5e-4


def test_normals_that_point_nowhere_or_down_end_nothing(make):
    normals = np.zeros((8, 8, 3))
    normals[2, 2] = [0, 0, -1]
    normals[4, 4] = [np.nan, np.inf, 0]

    assert np.isfinite(heights(make, normals, normal_range="signed")).all()
