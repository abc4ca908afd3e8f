"""Pictures of all directions, looked up on surfaces, in every layout."""

import math
from typing import Any

import numpy as np
import pytest
from pydantic import TypeAdapter

from api_schemas.language import FAMILIES
from api_schemas.members import Layout
from tests.worker.rendering.coded import ORTHOGRAPHIC, angles, directions, pixel_middles, shown
from tests.worker.rendering.studio import Studio
from worker import layouts

pytestmark = pytest.mark.gl

BALL = {"type": "sphere", "segments": 512, "rings": 256}
FILTERS = ["nearest", "bilinear", "trilinear", "anisotropic"]
WHOLE: dict[str, dict[str, Any]] = {"fisheye": {"angle": 2 * math.pi}}
COORDINATES = sorted(set(FAMILIES["coordinates"]) - {"facing", "toon"})


def layout(technique: str) -> Any:
    body = {"technique": technique, **WHOLE.get(technique, {})}
    return TypeAdapter(Layout).validate_python(body)


@pytest.mark.parametrize("filter_name", FILTERS[1:])
@pytest.mark.parametrize("technique", FAMILIES["layouts"])
def test_show_5_the_direction_is_read_that_is_looked_up(
    studio: Studio, technique: str, filter_name: str
) -> None:
    spec = layout(technique)
    across, down = spec.proportion
    unit = 128 if technique == "cube" else 512
    picture = directions(studio, spec, across * unit, down * unit)
    color = {
        "texture": picture,
        "coordinates": {"technique": "position"},
        "layout": spec.model_dump(),
        "filter": filter_name,
    }
    eye = np.array([0.48, 0.6, 0.64])

    for sign in (1.0, -1.0):
        camera = {**ORTHOGRAPHIC, "pose": {"eye": list(4 * sign * eye)}}
        drawn = shown(studio, BALL, color, 96, camera=camera)

        backward = sign * eye
        right = np.cross([0, 1.0, 0], backward)
        right /= np.linalg.norm(right)
        x, y = pixel_middles(96)
        out = np.sqrt(np.maximum(0, 1 - x * x - y * y))
        wanted = x[..., None] * right + y[..., None] * np.cross(backward, right)
        wanted = wanted + out[..., None] * backward
        inside = np.hypot(x, y) < 0.9
        error = angles(drawn[..., :3], wanted)[inside]
        assert np.median(error) < 0.1
        # Where a direction is a whole rim, or directions turn without bound at one, probes in a row
        # still tell, and squares of texels do not
        sharp = filter_name == "anisotropic" and technique != "hemispheres"
        assert np.quantile(error, 0.99 if sharp else 0.85) < 2.0


@pytest.mark.parametrize("filter_name", FILTERS)
@pytest.mark.parametrize("technique", FAMILIES["layouts"])
def test_show_5_a_constant_picture_stays_constant(
    studio: Studio, technique: str, filter_name: str
) -> None:
    color = {
        "texture": {"technique": "constant", "value": [0.3, 0.6, 0.1]},
        "coordinates": {"technique": "reflection"},
        "layout": layout(technique).model_dump(),
        "filter": filter_name,
    }

    drawn = shown(studio, BALL, color)

    seen = drawn[drawn[..., 3] > 0][:, :3]
    np.testing.assert_allclose(seen, np.broadcast_to([0.3, 0.6, 0.1], seen.shape), rtol=3e-7)


@pytest.mark.parametrize("technique", COORDINATES)
def test_show_5_a_constant_stays_constant_wherever_it_is_looked_up(
    studio: Studio, technique: str
) -> None:
    color = {
        "texture": {"technique": "constant", "value": [0.3, 0.6, 0.1]},
        "coordinates": {"technique": technique},
    }

    drawn = shown(studio, BALL, color)

    seen = drawn[drawn[..., 3] > 0][:, :3]
    np.testing.assert_array_equal(seen, np.broadcast_to(np.float32([0.3, 0.6, 0.1]), seen.shape))


@pytest.mark.parametrize("technique", ["angular_probe", "mirror_ball", "hemispheres"])
def test_what_is_round_a_disc_does_not_bleed_into_it(studio: Studio, technique: str) -> None:
    spec = layout(technique)
    across, down = spec.proportion
    _, valid = layouts.direction(spec, layouts.texel_middles(across * 64, down * 64))
    picture = np.where(valid, 1.0, -1000.0).reshape(down * 64, across * 64)
    color = {
        "texture": studio.texture(picture),
        "coordinates": {"technique": "position"},
        "layout": spec.model_dump(),
    }

    for eye in ([0, 0, 4.0], [0, 0, -4.0], [4.0, 0, 0]):
        drawn = shown(studio, BALL, color, camera={**ORTHOGRAPHIC, "pose": {"eye": eye}})

        np.testing.assert_allclose(drawn[drawn[..., 3] > 0][:, 0], 1.0, atol=1e-5)


def test_beyond_a_fisheye_all_is_black(studio: Studio) -> None:
    color = {
        "texture": {"technique": "constant", "value": 1.0},
        "coordinates": {"technique": "position"},
        "layout": {"technique": "fisheye", "angle": 2.0, "towards": "+z"},
        "filter": "nearest",
    }

    drawn = shown(studio, BALL, color, 64)

    x, y = pixel_middles(64)
    angle = np.arcsin(np.minimum(np.hypot(x, y), 1))
    assert (drawn[angle < 0.98][:, 0] == 1).all()
    assert (drawn[(angle > 1.02) & (np.hypot(x, y) < 0.99)][:, 0] == 0).all()
