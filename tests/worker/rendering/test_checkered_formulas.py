"""X25 and T67 at the fragment: checkerboards worked out at every pixel of T39's plane."""

from typing import Any

import numpy as np
import pytest

from tests.checkered_plane import SIDE, exact_plane, plane_scene, rms, squares, triangle_wave
from tests.worker.rendering.studio import Studio

pytestmark = pytest.mark.gl

COLORS = [[1.0, 1.0, 1.0], [0.0, 0.0, 0.0]]


@pytest.fixture(scope="module")
def exact() -> np.ndarray:
    return exact_plane()


def drawn(studio: Studio, texture: dict[str, Any], filter_name: str) -> np.ndarray:
    color = {"texture": texture, "filter": filter_name}
    return studio.draw(plane_scene(color), (SIDE, SIDE))


def test_x25_the_mean_of_a_box_has_no_alias(studio: Studio, exact: np.ndarray) -> None:
    board = {"technique": "checkerboard", "cells": [2, 2], "colors": COLORS}

    picture = drawn(studio, board, "formula")

    assert np.isfinite(picture).all()
    np.testing.assert_allclose(picture[SIDE // 2, :, 0], 0.5, atol=1e-3)
    as_picture = drawn(studio, studio.texture(squares()), "trilinear")
    assert rms(picture, exact) < 0.8 * rms(as_picture, exact)
    # Seen straight on, the box of a pixel is upright and its mean exact.
    wall = plane_scene({"texture": board, "filter": "formula"})
    wall["camera"] = {
        "type": "orthographic",
        "height": 7.3,
        "pose": {"eye": [0.2, 2.0, -0.1], "target": [0.2, 0.0, -0.1], "up": [0.0, 0.0, -1.0]},
    }
    edges = (np.arange(65) - 32) * 7.3 / 64
    u, v = (np.diff(triangle_wave(edges + shift)) / (7.3 / 64) for shift in (0.2, 0.1))
    expected = 0.5 + 0.5 * np.outer(v[::-1], u)
    np.testing.assert_allclose(studio.draw(wall, (64, 64))[..., 0], expected, atol=2e-4)


@pytest.mark.parametrize("window", ["truncated", "fejer", "lanczos", "gaussian"])
def test_t67_waves_that_pixels_hold_are_nearer_than_bare_samples(
    studio: Studio, exact: np.ndarray, window: str
) -> None:
    texture = {
        "technique": "band_limited_checkerboard",
        "cells": [2, 2],
        "colors": COLORS,
        "window": window,
    }

    picture = drawn(studio, texture, "formula")

    assert np.isfinite(picture).all()
    # T40: at z = sqrt(f h) even the fundamental is too fine along z; all is grey from there on.
    grey = picture[SIDE // 2 : SIDE // 2 + int(np.sqrt(200.0)) - 1, :, 0]
    np.testing.assert_allclose(grey, 0.5, atol=1e-5)
    bare = drawn(studio, studio.texture(squares()), "nearest")
    assert rms(picture, exact) < rms(bare, exact)
