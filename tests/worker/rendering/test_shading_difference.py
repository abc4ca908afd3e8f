"""T61: what is averaged and then shaded against what is shaded and then averaged."""

from typing import Any

import numpy as np
import pytest

from tests.worker.rendering.studio import Studio

pytestmark = pytest.mark.gl

SIZE = (16, 16)
LIGHTS = [{"type": "directional", "direction": [-0.3, -0.4, -1.0], "irradiance": 1.5}]
LAYERS = ["shading_difference"]


def poster(surface: dict[str, Any]) -> dict[str, Any]:
    return {
        "camera": {"type": "orthographic", "height": 2.0, "pose": {"eye": [0.0, 0.0, 2.0]}},
        "lights": LIGHTS,
        "nodes": [{"mesh": {"type": "plane"}, "surface": surface}],
    }


def colors(studio: Studio) -> dict[str, Any]:
    """32 texels along a pixel, whose means over upright boxes are exact."""
    noise = np.random.default_rng(3).random((512, 512, 3))
    return {"texture": studio.texture(noise), "filter": "summed_area"}


def bumps(studio: Studio, amplitude: float) -> dict[str, Any]:
    """Flat bumps of 8 x 8 texels, sixteen in a pixel."""
    tilt = amplitude * np.random.default_rng(4).normal(size=(64, 64, 2))
    tilt = tilt.repeat(8, axis=0).repeat(8, axis=1)
    normals = np.dstack([tilt, np.ones((512, 512))])
    return {"texture": studio.texture(normals), "range": "signed", "filter": "summed_area"}


@pytest.mark.parametrize("supersampling", [2, 4])
def test_t61_linear_shading_commutes_with_averaging(studio: Studio, supersampling: int) -> None:
    surface = {"technique": "phong", "diffuse_color": colors(studio), "specular_weight": 0.0}

    drawn = studio.layers(poster(surface), LAYERS, SIZE, supersampling)

    assert drawn["picture"][..., :3].std() > 0.005
    np.testing.assert_allclose(drawn["shading_difference"], 0, atol=2e-5)


def test_t61_highlights_of_bumps_do_not(studio: Studio) -> None:
    # The mean normal mirrors no light to the eye; of bumps some lean halfway to it.
    surface = {
        "technique": "phong",
        "diffuse_weight": 0.0,
        "specular_weight": 1.0,
        "exponent": 200.0,
        "normal": bumps(studio, 0.2),
    }

    drawn = studio.layers(poster(surface), LAYERS, SIZE, 8)

    assert drawn["shading_difference"].mean() > 0.01
    difference, picture = drawn["shading_difference"], drawn["picture"][..., :3]
    once = studio.draw(poster(surface), SIZE)[..., :3]
    np.testing.assert_allclose(difference, picture - once, atol=1e-6)


def test_t61_of_one_sample_there_is_no_difference(studio: Studio) -> None:
    surface = {"technique": "phong", "normal": bumps(studio, 0.5)}

    drawn = studio.layers(poster(surface), LAYERS, SIZE, 1)

    assert (drawn["shading_difference"] == 0).all()


def test_t61_tiles_tell_the_same(studio: Studio, monkeypatch: pytest.MonkeyPatch) -> None:
    from worker.rendering import renderer  # noqa: PLC0415  needs OpenGL

    surface = {"technique": "phong", "normal": bumps(studio, 0.5), "specular_weight": 0.4}
    whole = studio.layers(poster(surface), LAYERS, SIZE, 2)
    monkeypatch.setattr(renderer, "LAYERED_SAMPLES_MAX", SIZE[0] * 6 * 4)

    in_tiles = studio.layers(poster(surface), LAYERS, SIZE, 2)

    np.testing.assert_allclose(
        in_tiles["shading_difference"], whole["shading_difference"], atol=1e-5
    )
