"""Chalk by nine harmonics of the sky (T37), which are evaluated at every pixel."""

import numpy as np
import pytest
from pydantic import TypeAdapter

from api_schemas.members import Texture
from tests.worker.rendering.studio import Studio
from tests.worker.rendering.surroundings import CHALK, ball, ball_normals, latlong
from worker.geometry.mesh import Mesh
from worker.synthesis import irradiance

pytestmark = [pytest.mark.gl, pytest.mark.usefixtures("small_cubes")]


def test_t37_a_chalk_ball_is_the_irradiance_map(studio: Studio) -> None:
    # From above, parallel rays meet the normals that the layout of hemispheres has there: a point
    # for each pixel of the ball, since triangles would round its normals off.
    light = latlong(64)
    picture = studio.texture(0.4 + 0.2 * light @ [0.5, 0.3, -0.4] + 0.3 * light[..., 0] ** 2)
    side = 64
    spec = TypeAdapter(Texture).validate_python(
        {
            "technique": "irradiance",
            "environment": picture,
            "to": {"technique": "hemispheres"},
            "method": "harmonics",
        }
    )
    environment = studio.make(spec.environment, "colour")
    made = irradiance.synthesize(
        spec, (2 * side, side), {"environment": environment}, lambda share, step: None
    )
    normals, on_it = ball_normals(side)
    x, z, y = np.moveaxis(normals[on_it], -1, 0)
    points = np.stack([x, y, -z], axis=1)
    ball_of_points = Mesh(
        positions=points,
        normals=points,
        uv_sets=(),
        triangles=np.arange(len(points), dtype=np.uint32)[:, None],
        kind="points",
    )
    scene = {
        "camera": {
            "type": "orthographic",
            "height": 2.0,
            "pose": {"eye": [0.0, 4.0, 0.0], "target": [0.0, 0.0, 0.0], "up": [0.0, 0.0, -1.0]},
        },
        "environment": {"texture": picture, "matt": "harmonics"},
        "nodes": [{"mesh": studio.mesh(ball_of_points), "surface": CHALK}],
    }

    seen = studio.draw(scene, (side, side))

    # The left square has x to the right and z upwards: the eye that looks down has -z upwards.
    expected = made.image.pixels[::-1, :side, :3]
    np.testing.assert_allclose(seen[on_it][:, :3], expected[on_it], atol=1e-6)


def test_t37_harmonics_below_zero_are_dark(studio: Studio) -> None:
    # One bright direction: nine harmonics are negative on the far side, and chalk is not.
    light = np.where(latlong(64)[..., 1:2] > 0.97, [50.0, 5.0, 0.0], 0.0)
    sky = {"texture": studio.texture(light), "matt": "harmonics", "visible": False}

    seen = ball(studio, sky, CHALK, 32)
    cube = ball(studio, {**sky, "matt": "sum"}, CHALK, 32)

    assert seen[..., :3].min() == 0
    assert not seen[..., 2].any()
    # A clamped cosine and its nine harmonics are at most 0.07 of the light above each other.
    np.testing.assert_allclose(seen, cube, atol=0.1 * cube.max())
