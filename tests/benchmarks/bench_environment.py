"""Environments: what is made of them, and what shining with them costs

Of a picture of 512 x 256 texels with a lamp in it, processor seconds of all threads, the better of
two; `a chain` is what a scene's environment is made into for rough mirrors: six faces of 96 texels
at roughness 0.2, 48 at 0.4 and so on. Then frames of 512 x 512 pixels, one sample each, whose
environment is made already: of a ball that fills the picture, under one lamp.
"""

import json
import time
from collections.abc import Callable
from typing import Any

import numpy as np
from pydantic import TypeAdapter

from api_schemas.environment import Environment
from api_schemas.families import Meaning
from api_schemas.members import Texture
from api_schemas.output import RenderOutput
from api_schemas.scene import Scene
from api_schemas.sky import sky_textures
from api_schemas.textures.image import ImageSpec
from tests.worker.rendering.studio import Studio
from tests.worker.rendering.surroundings import BALL_CAMERA, CHALK, MIRROR, latlong
from worker import synthesis
from worker.images.image import Image

SIDE = 512
FRAMES = 5
ASSET = {"technique": "image", "asset": "0" * 64}
LAMP = {"type": "point", "position": [2.0, 3.0, 4.0], "intensity": 40.0}
SHADOW = {"shadow": {"resolution": 1024}}


def measure() -> list[dict[str, object]]:
    """Measure this module's table."""
    from worker.rendering.renderer import render  # noqa: PLC0415  opens OpenGL

    light = lamp_in_a_sky()
    rows = [made(work, spec, light) for work, spec in textures()]
    studio = Studio(render)
    sky = {"environment": {"texture": studio.texture(light)}}
    room = {"surroundings": {"side": 128}}
    plain = frame(studio, CHALK, {}, {})
    for work, surface, scene, node in (
        ("matt, one lamp", CHALK, {}, {}),
        ("matt, one lamp with a shadow", CHALK, {"lights": [LAMP | SHADOW]}, {}),
        ("matt, in an environment", CHALK, sky, {}),
        ("mirror, in an environment", MIRROR, sky, {}),
        ("mirror, in an environment and its surroundings", MIRROR, sky, room),
        ("the same, by hemispheres", MIRROR, sky, {"surroundings": {"layout": "hemispheres"}}),
    ):
        seconds = frame(studio, surface, scene, node)
        rows.append(row(work, seconds, seconds - plain))
    return rows


def lamp_in_a_sky() -> np.ndarray:
    towards = latlong(512)
    sun = towards @ np.array([0.36, 0.48, 0.8]) > 0.997
    light = 0.5 + 0.5 * towards[..., 1] + 500.0 * sun
    return np.repeat(light[..., np.newaxis], 3, axis=-1).astype(np.float32)


def textures() -> list[tuple[str, Any]]:
    sky = sky_textures(Environment(texture=ImageSpec.model_validate(ASSET)))
    cube = {"technique": "convert_layout", "environment": ASSET, "to": {"technique": "cube"}}
    return [
        ("a chain", sky.rough),
        ("the light on matt surfaces, six faces of 48", sky.matt),
        ("another layout, six faces of 512", TypeAdapter(Texture).validate_python(cube)),
    ]


def made(work: str, spec: Any, light: np.ndarray) -> dict[str, object]:
    def found(picture: ImageSpec, meaning: Meaning) -> Image:
        return Image(light, "colour")

    def make() -> None:
        synthesis.synthesize(spec, spec.surface_size, found)

    return row(work, min(clocked(make, time.process_time) for _ in range(2)), None)


def frame(
    studio: Studio, surface: dict[str, Any], scene: dict[str, Any], node: dict[str, Any]
) -> float:
    ball = {"mesh": {"type": "sphere"}, "surface": surface, **node}
    body = {"camera": BALL_CAMERA, "lights": [LAMP], "nodes": [ball], **scene}
    drawn = Scene.model_validate_json(json.dumps(body))
    output = RenderOutput(size=[SIDE, SIDE], supersampling=1)

    def draw() -> None:
        list(studio._render(drawn, output, studio.maker, None, lambda share, stage: None).bands)

    draw()
    return min(clocked(draw, time.perf_counter) for _ in range(FRAMES))


def clocked(work: Callable[[], None], clock: Callable[[], float]) -> float:
    start = clock()
    work()
    return clock() - start


def row(work: str, seconds: float, more: float | None) -> dict[str, object]:
    return {
        "work": work,
        "ms": round(1000 * seconds),
        "more than matt under one lamp, ms": "" if more is None else round(1000 * more),
    }
