"""T67: the checkerboard of finitely many waves, against the sums of exercise 20.3."""

import numpy as np
import pytest
from pydantic import TypeAdapter, ValidationError

from api_schemas.members import Texture
from tests.checkered_plane import FOCAL, SIDE, exact_plane
from worker.synthesis.band_limited_checkerboard import closed_form, color_at

TEXTURE = TypeAdapter(Texture)


def board(**more):
    body = {"technique": "band_limited_checkerboard", "colors": [[1.0] * 3, [0.0] * 3]}
    return TEXTURE.validate_python(body | {"cells": [2, 2]} | more)


def wave(x, **more):
    """S at places in squares: in the middle of a square along v, where S is that of x = 1/2."""
    x = np.atleast_1d(np.asarray(x, float))
    places = np.stack([x / 2, np.full_like(x, 0.25)], axis=1)
    share = color_at(board(**more), places, [0.0, 0.0])[:, 0]
    middle = np.sqrt(2 * color_at(board(**more), np.array([[0.25, 0.25]]), [0.0, 0.0])[0, 0] - 1)
    return (2 * share - 1) / middle


def test_a9_t67_one_wave() -> None:
    assert wave(0.5, window="truncated", band_limit=2) == pytest.approx(1.273239545, abs=1e-8)


@pytest.mark.parametrize(
    ("window", "half", "quarter"),
    [("truncated", 1.103474272, 1.020358492), ("fejer", 0.891267681, 0.870305772)],
)
def test_a9_t67_three_waves(window: str, half: float, quarter: float) -> None:
    # K = {1, 3, 5}; Fejer's weights are 1 - k / 6.
    found = wave([0.5, 0.25], window=window, band_limit=6)

    np.testing.assert_allclose(found, [half, quarter], atol=1e-8)


def test_a9_t67_how_far_fifty_waves_overshoot() -> None:
    # Gibbs: the first maximum is at x = 1 / 100, its limit (2 / pi) Si(pi) = 1.178979744.
    x = np.append(np.linspace(0, 1, 20001), 0.5)

    truncated = wave(x, window="truncated", band_limit=100)
    fejer = wave(x, window="fejer", band_limit=100)

    assert truncated.max() == pytest.approx(1.179013079, abs=1e-6)
    assert min(x[truncated.argmax()], 1 - x[truncated.argmax()]) == pytest.approx(0.01, abs=1e-4)
    assert fejer.max() == fejer[-1] == pytest.approx(0.993634439, abs=1e-6)


def test_t67_softer_windows_ring_less() -> None:
    x = np.linspace(0, 1, 4001)
    highest = {
        window: wave(x, window=window, band_limit=40).max()
        for window in ("truncated", "lanczos", "fejer", "gaussian")
    }

    assert highest["truncated"] > 1.17
    assert 1.0 < highest["lanczos"] < 1.03  # about an eighth of Gibbs' overshoot is left
    assert highest["fejer"] <= 1
    assert highest["gaussian"] <= 1 + 1e-3


def test_t67_a_picture_is_the_formula_at_its_pixels(make) -> None:
    body = {"technique": "band_limited_checkerboard", "cells": [6, 4], "band_limit": 9.5}
    column, row = np.meshgrid(np.arange(40), np.arange(30))
    places = np.stack([(column + 0.5) / 40, 1 - (row + 0.5) / 30], axis=2).reshape(-1, 2)

    pixels = make(body, (40, 30))

    expected = color_at(TEXTURE.validate_python(body), places, [1 / 40, 1 / 30])
    np.testing.assert_allclose(pixels.reshape(-1, 3), expected, atol=1e-6)


def test_t40_t67_pixels_decide_the_limit(make) -> None:
    # w = 1/4 of a square: k < 4, so one wave along u and v but for k = 1 and 3.
    body = {"technique": "band_limited_checkerboard", "cells": [8, 8], "window": "truncated"}

    np.testing.assert_array_equal(make(body, (32, 32)), make(body | {"band_limit": 4.0}, (32, 32)))
    # Squares of a pixel or less are grey: even the fundamental is beyond what pixels hold.
    np.testing.assert_allclose(make(body, (8, 8)), 0.5, atol=1e-7)
    np.testing.assert_allclose(make(body, (3, 5)), 0.5, atol=1e-7)


@pytest.mark.parametrize("window", ["truncated", "fejer", "lanczos", "gaussian"])
def test_t67_of_equal_colours_nothing_is_seen(make, window: str) -> None:
    body = {"technique": "band_limited_checkerboard", "colors": [[0.3] * 3] * 2, "window": window}

    assert (make(body, (48, 48)) == np.float32(0.3)).all()


def test_t67_on_the_plane_every_window_is_nearer_than_bare_samples() -> None:
    # T39's plane, a row at a time: in it a pixel is z / f wide and z^2 / f deep.
    exact = exact_plane()
    columns = np.arange(SIDE) + 0.5 - SIDE / 2
    off = {}
    for window in ("truncated", "fejer", "lanczos", "gaussian"):
        texture = board(window=window)
        rows = []
        for row in range(SIDE // 2):
            z = FOCAL / (row + 0.5)
            places = np.stack([z * columns / FOCAL, np.full(SIDE, z)], axis=1) / 2
            rows.append(color_at(texture, places, [z / FOCAL / 2, z * z / FOCAL / 2])[:, 0])
        off[window] = np.sqrt(np.mean((np.array(rows) - exact) ** 2))
    z = FOCAL / (np.arange(SIDE // 2)[:, None] + 0.5)
    bare = (np.floor(z) + np.floor(z * columns / FOCAL)) % 2 == 0
    aliased = np.sqrt(np.mean((bare - exact) ** 2))

    assert all(value < aliased for value in off.values()), (aliased, off)


def test_t67_there_is_a_formula_in_the_plane_only() -> None:
    assert closed_form(board(), solid=True) is None
    assert closed_form(board(), solid=False)["band_limit"] == 0


@pytest.mark.parametrize("limit", [0, -1, 513, float("nan"), float("inf"), "6", True])
def test_t67_limits_that_mean_nothing_are_refused(limit: object) -> None:
    with pytest.raises(ValidationError):
        board(band_limit=limit)
