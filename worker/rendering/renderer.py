"""Draw a request's scene: build, tile by tile, resolved to one float picture."""

import atexit
import functools
import time
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np

from api_schemas.families import Meaning, TextureSpec
from api_schemas.language import FAMILIES
from api_schemas.model_mesh import ModelMesh
from api_schemas.output import RenderOutput
from api_schemas.scene import Scene
from worker.errors import RenderError
from worker.geometry.model import Model
from worker.images.image import Image
from worker.rendering.gl_context import GLContext, check
from worker.rendering.lighting import light_uniforms
from worker.rendering.pyrender_adapter import FloatRenderer, pyrender_scene
from worker.rendering.scene_builder import ModelReader, SceneBuilder, TextureMaker
from worker.rendering.shading import surface_fields
from worker.rendering.targets import TargetPair
from worker.rendering.tiles import pixels_per_tile, tile_from_picture, tiles
from worker.stages import Report


@dataclass(frozen=True, slots=True)
class Rendering:
    """A picture and what it cost.

    Attributes:
        image: float32 (height, width, 4), linear, alpha premultiplied; 0 where nothing is.
        timings: Milliseconds: draw_ms, and jit_ms for linking programs and their first draws.
        counts: triangles and texels.
        warnings: What uploaded models ask for and do not get.
    """

    image: Image
    timings: dict[str, float]
    counts: dict[str, int]
    warnings: tuple[str, ...]


class _Engine:
    """The context of this process and what lives in it."""

    def __init__(self) -> None:
        self.context = GLContext.open()
        self.renderer = FloatRenderer(self.context)
        self.targets = TargetPair()
        self.builder = SceneBuilder()
        # pyrender's destructor would call OpenGL from a half-gone interpreter.
        atexit.register(self.renderer.delete)


@functools.cache
def _engine() -> _Engine:
    return _Engine()


def render(
    scene: Scene,
    output: RenderOutput,
    textures: TextureMaker,
    models: ModelReader,
    report: Report,
) -> Rendering:
    """Draw a scene as linear light.

    Always call it from the same thread; the first call opens the process's OpenGL context.

    Args:
        scene: What to draw.
        output: Its size and supersampling count here; the file is not this function's business.
        textures: Makes the picture of a texture, read as "colour" or "data".
        models: Reads uploaded models.
        report: Called with the finished part, 0..1, and the stage's name.

    Raises:
        WorkerError: The scene cannot be drawn.
    """
    engine = _engine()
    engine.context.check_thread()
    width, height = output.size
    report(0.0, "build")
    built = engine.builder.build(scene, width / height, textures, models)
    lights = light_uniforms(built.lights, built.view.world_from_camera[:3, 3])
    drawn = pyrender_scene(built.drawables, built.view)
    pixels = np.empty((height, width, 4), dtype=np.float32)
    start, jit_before = time.perf_counter(), engine.renderer.jit_seconds
    side = pixels_per_tile(output.supersampling)
    target = engine.targets.fit(min(width, side), min(height, side), output.supersampling)
    parts = list(tiles(width, height, output.supersampling))
    for done, tile in enumerate(parts):
        report(done / len(parts), "draw")
        samples = (tile.width * output.supersampling, tile.height * output.supersampling)
        engine.renderer.draw(
            drawn,
            built.view,
            lights,
            target,
            tile_from_picture(tile, width, height),
            samples,
            output.supersampling,
        )
        top = height - tile.bottom - tile.height
        engine.targets.resolve(
            output.supersampling,
            pixels[top : top + tile.height, tile.left : tile.left + tile.width],
        )
    check("resolving samples")
    jit = engine.renderer.jit_seconds - jit_before
    timings = {
        "draw_ms": round((time.perf_counter() - start - jit) * 1000, 3),
        "jit_ms": round(jit * 1000, 3),
    }
    counts = {"triangles": built.triangles, "texels": built.texels}
    engine.builder.trim()
    engine.renderer.trim()
    report(1.0, "draw")
    return Rendering(Image(pixels, "colour"), timings, counts, built.warnings)


def fingerprint() -> str:
    """Name the OpenGL implementation that decides the pixels."""
    return _engine().context.fingerprint()


def warm(report: Report) -> None:
    """Draw every surface plain and with one map in each colour, so that nothing is left to compile.

    What is compiled here also fills Mesa's cache on disk, which later processes find.
    """
    output = RenderOutput(size=[16, 16], supersampling=2)
    surfaces = list(_typical())
    for done, surface in enumerate(surfaces):
        report(done / len(surfaces), f"compile {surface['technique']}")
        render(_poster(surface), output, _grey, _no_model, lambda fraction, stage: None)
    report(1.0, "compile")


def _typical() -> Iterator[dict[str, Any]]:
    texture = {"technique": "constant", "value": [0.5, 0.5, 0.5]}
    for technique in FAMILIES["surfaces"]:
        yield {"technique": technique}
        for name, kind in surface_fields(technique).items():
            if kind == "vec3":
                yield {"technique": technique, name: {"texture": texture}}


def _poster(surface: dict[str, Any]) -> Scene:
    return Scene.model_validate(
        {
            "camera": {"type": "orthographic", "pose": {"eye": [0.0, 0.0, 2.0]}},
            "nodes": [{"mesh": {"type": "plane"}, "surface": surface}],
        }
    )


def _no_model(mesh: ModelMesh) -> Model:
    raise RenderError("there is no model to warm up with")


def _grey(spec: TextureSpec, meaning: Meaning) -> Image:
    return Image(np.full((2, 2, 3), 0.5, dtype=np.float32), meaning)
