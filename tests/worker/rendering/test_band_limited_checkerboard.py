"""T67 at the fragment: the chunk against the points of the CPU."""

import numpy as np
import pytest
from pydantic import TypeAdapter

from api_schemas.members import Texture
from worker import synthesis
from worker.synthesis.band_limited_checkerboard import color_at

pytestmark = pytest.mark.gl


@pytest.mark.parametrize("window", ["truncated", "fejer", "lanczos", "gaussian"])
@pytest.mark.parametrize("limit", [None, 6.0, 511.0])
def test_t67_a_fragment_shows_what_the_point_has(window: str, limit: float | None) -> None:
    from tests.worker.rendering.formula_drawing import drawn  # noqa: PLC0415  needs OpenGL

    body = {"technique": "band_limited_checkerboard", "cells": [6, 5], "window": window}
    texture = TypeAdapter(Texture).validate_python(body | {"band_limit": limit})
    places = np.random.default_rng(5).uniform(-2, 3, (2048, 3)).astype(np.float32)
    places[:, 2] = 0
    steps = np.array([[1.0, 0.25, 0.0], [0.0, 1.0, 0.0]]) / 130

    shown = drawn(synthesis.closed_form(texture, solid=False), places, steps)

    expected = color_at(texture, places[:, :2].astype(float), [1 / 130, 1.25 / 130])
    np.testing.assert_allclose(shown[:, :3], expected, atol=1e-5)
    assert (shown[:, 3] == 1).all()
