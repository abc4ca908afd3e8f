"""Cube maps: six faces found by a direction, filtered across their edges."""

import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from api_schemas.layouts.cube import CubeSpec
from tests.worker.rendering.coded import ORTHOGRAPHIC, angles, directions, pixel_middles, shown
from tests.worker.rendering.studio import Studio
from tests.worker.rendering.test_letters import LETTER
from tests.worker.rendering.test_wrapped_round import assert_f
from worker.images import image_io
from worker.layouts.cube import cells

pytestmark = pytest.mark.gl

BALL = {"type": "sphere", "segments": 512, "rings": 256}
ROOM = {"type": "box", "width": 2.0, "height": 2.0, "depth": 2.0}
ARRANGEMENTS = ("column", "row", "cross", "tall_cross")
ORIENTATIONS = ("openexr", "gl")


def cube(arrangement: str = "column", orientation: str = "openexr") -> CubeSpec:
    body = {"technique": "cube", "arrangement": arrangement, "orientation": orientation}
    return CubeSpec.model_validate(body)


def around(texture: Any, layout: CubeSpec, **more: Any) -> dict[str, Any]:
    return {
        "texture": texture,
        "coordinates": {"technique": "position"},
        "layout": layout.model_dump(),
        **more,
    }


@pytest.mark.parametrize("filter_name", ["bilinear", "trilinear", "anisotropic"])
@pytest.mark.parametrize("orientation", ORIENTATIONS)
@pytest.mark.parametrize("arrangement", ARRANGEMENTS)
def test_t20_every_direction_is_found(
    studio: Studio, arrangement: str, orientation: str, filter_name: str
) -> None:
    layout = cube(arrangement, orientation)
    columns, rows = layout.proportion
    picture = directions(studio, layout, 64 * columns, 64 * rows)
    corner = np.array([0.48, 0.6, 0.64])  # three faces are seen

    for side in (1.0, -1.0):
        camera = {**ORTHOGRAPHIC, "pose": {"eye": list(4 * side * corner)}}
        drawn = shown(studio, BALL, around(picture, layout, filter=filter_name), 65, camera=camera)

        backward = side * corner
        right = np.cross([0, 1.0, 0], backward)
        right /= np.linalg.norm(right)
        x, y = pixel_middles(65)
        out = np.sqrt(np.maximum(0, 1 - x * x - y * y))
        wanted = x[..., None] * right + y[..., None] * np.cross(backward, right)
        wanted = wanted + out[..., None] * backward
        inside = np.hypot(x, y) < 0.9
        # A texel is 1.8 degrees; blends of unit vectors are off by its square, and across edges,
        # where steps between texels change, by a tenth of one; corners have three texels
        error = angles(drawn[..., :3], wanted)[inside]
        assert error.max() < 0.5
        assert np.quantile(error, 0.99) < 0.18
        assert np.median(error) < 0.03


@pytest.mark.parametrize("orientation", ORIENTATIONS)
@pytest.mark.parametrize("face", ["+x", "-x", "+y", "-y", "+z", "-z"])
def test_t20_a_letter_on_each_face_reads(studio: Studio, face: str, orientation: str) -> None:
    # From within where the faces are right as seen from within; OpenGL's are mirrored
    layout = cube("row", orientation)
    column, _, _ = cells(layout)[face]
    letter = LETTER[:, ::-1] if orientation == "gl" else LETTER
    if orientation == "gl" and face[1] == "y":
        letter = LETTER[::-1]  # these have their t turned, which is as good as a mirror
    picture = np.zeros((64, 6 * 64, 3), np.float32)
    picture[:, column * 64 : column * 64 + 64] = letter
    target = {"x": [1.0, 0, 0], "y": [0, 1.0, 0], "z": [0, 0, 1.0]}[face[1]]
    up = {"+y": [0, 0, 1.0], "-y": [0, 0, -1.0]}.get(face, [0, 1.0, 0])
    sign = float(face[0] + "1")
    pose = {"eye": [0.0, 0, 0], "target": [sign * x for x in target], "up": up}
    camera = {"type": "perspective", "fov_y": math.pi / 2, "pose": pose}

    drawn = shown(
        studio, ROOM, around(studio.texture(picture), layout), 128, camera={**camera, "near": 0.01}
    )

    assert_f(drawn)


@pytest.mark.parametrize("filter_name", ["nearest", "bilinear", "trilinear", "anisotropic"])
def test_a_constant_cube_is_constant(studio: Studio, filter_name: str) -> None:
    constant = {"technique": "constant", "value": [0.3, 0.6, 0.1]}

    drawn = shown(studio, BALL, around(constant, cube(), filter=filter_name))

    seen = drawn[drawn[..., 3] > 0][:, :3]
    # Three texels at a corner are added up by thirds
    np.testing.assert_allclose(seen, np.broadcast_to([0.3, 0.6, 0.1], seen.shape), rtol=3e-7)


def test_far_away_a_cube_is_its_mean_across_edges(studio: Studio) -> None:
    # Random texels: a small ball shows means of many
    random = np.random.default_rng(4).random((6 * 64, 64, 3))
    color = around(studio.texture(random), cube())

    drawn = shown(studio, BALL, color, 4, camera={**ORTHOGRAPHIC, "height": 2.0})

    # 4 x 4 pixels, each some 500 texels of standard deviation .29
    assert np.abs(drawn[1:3, 1:3, :3] - 0.5).max() < 0.06


@pytest.mark.corpus
def test_show_2_wavy_lines_are_the_same_from_a_cube_and_from_longitude_and_latitude(
    studio: Studio, corpus: Path
) -> None:
    folder = corpus / "2_envmaps"
    cube_file = next(folder.rglob("WavyLinesCube.exr"))
    latlong_file = next(folder.rglob("WavyLinesLatLong.exr"))
    pictures = [
        image_io.read(file, "linear", "colour").pixels for file in (cube_file, latlong_file)
    ]
    balls = [
        shown(
            studio,
            BALL,
            {
                "texture": studio.texture(pixels),
                "coordinates": {"technique": "reflection"},
                "layout": {"technique": technique},
            },
            128,
        )[..., :3]
        for technique, pixels in zip(("cube", "latlong"), pictures, strict=True)
    ]

    x, y = pixel_middles(128)
    inside = np.hypot(x, y) < 0.95
    error = np.abs(balls[0] - balls[1]).max(axis=2)[inside]
    # Lines three texels wide, from .1 to .9, of pictures that differ in where texels lie by up to
    # half of one; a mirrored or turned face would leave a correlation of a half
    assert np.sqrt((error**2).mean()) < 0.06
    assert np.corrcoef(balls[0][inside].ravel(), balls[1][inside].ravel())[0, 1] > 0.95
