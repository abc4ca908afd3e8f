"""Light beyond what float32 holds is cut off: finite requests give finite pictures."""

import numpy as np
import pytest

from api_schemas.base import FLOAT32_MAX
from tests.worker.rendering.studio import Studio

pytestmark = pytest.mark.gl

BRIGHTEST = [FLOAT32_MAX] * 3
LIGHTS = {
    "point": {"position": [0, 0, 1], "color": BRIGHTEST, "intensity": FLOAT32_MAX},
    "directional": {"direction": [0, 0, -1], "color": BRIGHTEST, "irradiance": FLOAT32_MAX},
    "ambient": {"radiance": BRIGHTEST},
}


@pytest.mark.parametrize("kind", LIGHTS)
def test_the_brightest_lights_leave_black_black(studio: Studio, kind: str) -> None:
    lights = [{"type": kind, **LIGHTS[kind]}] * 3
    black = {"technique": "phong", "diffuse_color": [0, 0, 0], "specular_color": [0, 0, 0]}

    assert (studio.poster(black, lights=lights)[..., :3] == 0).all()


@pytest.mark.parametrize("kind", LIGHTS)
def test_the_brightest_lights_are_cut_off(studio: Studio, kind: str) -> None:
    lights = [{"type": kind, **LIGHTS[kind]}] * 3
    shiny = {"technique": "phong", "specular_weight": 1.0}

    pixels = studio.poster(shiny, lights=lights, supersampling=8)

    assert np.isfinite(pixels).all()
    assert pixels.max() > 1e36


@pytest.mark.parametrize("filter_name", ["nearest", "bilinear", "trilinear", "anisotropic"])
def test_maps_of_the_largest_numbers_give_numbers(studio: Studio, filter_name: str) -> None:
    texture = studio.texture([[FLOAT32_MAX, -FLOAT32_MAX], [0.0, FLOAT32_MAX]])
    color = {
        "texture": texture,
        "filter": filter_name,
        "wrap": ["border", "border"],
        "border_color": [FLOAT32_MAX, -FLOAT32_MAX, FLOAT32_MAX, 1.0],
        "transform": {"scale": [3.0, 3.0], "offset": [-0.7, -0.7]},
        "scale": FLOAT32_MAX,
    }

    pixels = studio.poster({"technique": "unlit", "color": color}, supersampling=3)

    assert np.isfinite(pixels).all()


def test_what_is_no_number_in_an_upload_is_dark(studio: Studio) -> None:
    texture = studio.texture([[np.nan, 1.0], [np.inf, 1.0]])
    color = {"texture": texture, "filter": "nearest"}

    pixels = studio.poster({"technique": "unlit", "color": color}, (2, 2))

    np.testing.assert_array_equal(pixels[..., 0], np.float32([[0, 1], [5e36, 1]]))
