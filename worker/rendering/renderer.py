"""Draw a request's scene: build, tile by tile, resolved to bands of float pixels."""

import atexit
import functools
import time
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from types import MappingProxyType
from typing import Any

import numpy as np

from api_schemas.families import Meaning, TextureSpec
from api_schemas.language import FAMILIES
from api_schemas.model_mesh import ModelMesh
from api_schemas.output import RenderOutput
from api_schemas.scene import Scene
from api_schemas.textures.constant import ConstantSpec
from worker.errors import RenderError
from worker.geometry.transforms import Matrix
from worker.images.image import Image
from worker.models.model import Model
from worker.rendering.bands import Band, OpenBand
from worker.rendering.cryptomatte import Mattes, attributes, mattes_of
from worker.rendering.gl_context import GLContext, check
from worker.rendering.lighting import lighting
from worker.rendering.packing import SHADING_DIFFERENCE
from worker.rendering.pixel_filters import apron
from worker.rendering.placing import ModelReader
from worker.rendering.pyrender_adapter import FloatRenderer
from worker.rendering.pyrender_scene import FlatScene
from worker.rendering.scene_builder import BuiltScene, SceneBuilder
from worker.rendering.shading import surface_fields
from worker.rendering.surroundings import with_surroundings
from worker.rendering.targets import TargetPair
from worker.rendering.texture_maker import TextureMaker
from worker.rendering.tiles import (
    LAYERED_SAMPLES_MAX,
    SAMPLES_MAX,
    bands,
    tile_from_picture,
    tile_size,
    widened,
)
from worker.rendering.turntable import layers, sheet, turns_of
from worker.stages import Report

_GREY = ConstantSpec(technique="constant", value=[0.5, 0.5, 0.5])


@dataclass(slots=True)
class Rendering:
    """A picture that is drawn while its bands are read, and what it cost.

    Attributes:
        bands: The picture from the top: float32 (rows, width, channels), linear, alpha
            premultiplied; 0 where nothing is, but for the depth, which is 1e10 there.
        counts: triangles and texels.
        timings: Milliseconds, whole after the last band: build_ms, draw_ms, and jit_ms for linking
            programs and their first draws.
        attributes: What a file says beside the pixels, by name.
        report: What was found out about the scene while it was built; JSON-able.
        warnings: What uploaded models ask for and do not get.
    """

    bands: Iterator[Band]
    counts: dict[str, int]
    timings: dict[str, float]
    attributes: dict[str, str]
    report: dict[str, Any]
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

    def trim(self) -> None:
        """Free what exceeds the bounds of what is kept for later pictures."""
        self.builder.trim()
        self.renderer.trim()
        self.targets.trim()


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

    Always call it, and read its bands, from the same thread; the first call opens the process's
    OpenGL context. Nothing else may be rendered before the last band is read.

    Args:
        scene: What to draw.
        output: Its size, supersampling and layers count here, the file is not this function's
            business.
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
    start = time.perf_counter()
    turns = turns_of(output.turntable)
    built = engine.builder.build(
        scene,
        width / height,
        textures,
        models,
        tangents="tangent" in output.layers,
        turns=turns,
    )
    timings = {
        "build_ms": _milliseconds(time.perf_counter() - start),
        "draw_ms": 0.0,
        "jit_ms": 0.0,
    }
    counts = {"triangles": built.triangles, "texels": built.texels}
    mattes = mattes_of(built.drawables, output.layers)

    def frame(number: int, turn: Matrix) -> Iterator[Band]:
        def share(done: float, stage: str) -> None:
            report((number + done) / len(turns), stage)

        start = time.perf_counter()
        things = [replace(d, world_from_object=turn @ d.world_from_object) for d in built.drawables]
        turned = replace(built, drawables=tuple(things))
        seen = with_surroundings(turned, engine.renderer, engine.targets, engine.builder, textures)
        spent = _milliseconds(time.perf_counter() - start)
        timings["build_ms"] = round(timings["build_ms"] + spent, 3)
        return _bands(engine, seen, mattes, output, timings, share)

    frames = (frame(number, turn) for number, turn in enumerate(turns))
    if output.turntable is None:
        drawn = next(frames)
    elif output.turntable.arrangement == "sheet":
        drawn = sheet(frames, output.columns)
    else:
        drawn = layers(frames)
    finished = _finished(engine, drawn)
    return Rendering(finished, counts, timings, attributes(mattes), built.report, built.warnings)


def _finished(engine: _Engine, bands: Iterator[Band]) -> Iterator[Band]:
    """Yield bands, and free what is not kept for other pictures after the last one."""
    yield from bands
    engine.trim()


def _bands(
    engine: _Engine,
    built: BuiltScene,
    mattes: Mapping[str, Mattes],
    output: RenderOutput,
    timings: dict[str, float],
    report: Report,
) -> Iterator[Band]:
    start = time.perf_counter()
    scene = FlatScene(built.drawables, built.view, built.background, built.sky)
    eye = built.view.world_from_camera[:3, 3]
    visible = "light_visibility" in output.layers
    lights = lighting(built.lights, eye, built.cookies, scene.corners, visibility=visible)
    width, height = output.size
    supersampling = output.supersampling
    layered = bool(output.layers)
    most = LAYERED_SAMPLES_MAX if layered else SAMPLES_MAX
    around = apron(output.pixel_filter)
    size = tile_size(width, height, supersampling, most, around)
    target = engine.targets.fit(
        *size, supersampling, layered=layered, pixel_filter=output.pixel_filter
    )
    jit_before = engine.renderer.jit_seconds
    engine.renderer.draw_shadows(scene, lights)
    spent = time.perf_counter() - start
    for tiles in bands(width, height, size):
        start = time.perf_counter()
        above = height - tiles[0].bottom - tiles[0].height
        band = OpenBand.empty(output.layers, mattes, tiles[0].height, width, supersampling)
        for tile in tiles:
            report((above + tile.height * tile.left / width) / height, "draw")
            seen = widened(tile, around)
            engine.renderer.draw(
                scene,
                lights,
                target,
                tile_from_picture(seen, width, height),
                (seen.width * supersampling, seen.height * supersampling),
                supersampling,
            )
            band.read_samples(target, tile, supersampling, around)
            resolved = engine.targets.resolve(
                tile.width, tile.height, supersampling, output.pixel_filter
            )
            band.read(resolved, tile)
            if SHADING_DIFFERENCE in output.layers:
                place = tile_from_picture(tile, width, height)
                pixels = (tile.width, tile.height)
                engine.renderer.draw(scene, lights, target, place, pixels, supersampling=1)
                band.subtract(target, tile)
        check("resolving samples")
        spent += time.perf_counter() - start
        yield band.images()
    jit = engine.renderer.jit_seconds - jit_before
    timings["draw_ms"] = round(timings["draw_ms"] + _milliseconds(spent - jit), 3)
    timings["jit_ms"] = round(timings["jit_ms"] + _milliseconds(jit), 3)
    report(1.0, "draw")


def _milliseconds(seconds: float) -> float:
    return round(seconds * 1000, 3)


def fingerprint() -> str:
    """Name the OpenGL implementation that decides the pixels."""
    return _engine().context.fingerprint()


def warm(report: Report, textures: TextureMaker) -> None:
    """Draw every surface plain and with one map in each colour, so that nothing is left to compile.

    What is compiled here also fills Mesa's cache on disk, which later processes find.

    Args:
        report: Told the finished part, 0..1, and what is compiled.
        textures: Makes the tables that surfaces bring themselves; they are kept.
    """

    def picture(
        spec: TextureSpec,
        meaning: Meaning,
        proportion: tuple[int, int] = (1, 1),
        rendered: Mapping[str, Image] = MappingProxyType({}),
    ) -> Image:
        if spec == _GREY:
            return _grey(meaning)
        return textures.picture(spec, meaning, proportion, rendered)

    maker = replace(textures, picture=picture)

    output = RenderOutput(size=[16, 16], supersampling=2)
    surfaces = list(_typical())
    for done, surface in enumerate(surfaces):
        report(done / len(surfaces), f"compile {surface['technique']}")
        list(render(_poster(surface), output, maker, _no_model, lambda fraction, stage: None).bands)
    report(1.0, "compile")


def _typical() -> Iterator[dict[str, Any]]:
    texture = _GREY.model_dump()
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


def _grey(meaning: Meaning) -> Image:
    """Give a picture that has mip levels, as those have that are not one pixel."""
    return Image(np.full((2, 2, 3), 0.5, dtype=np.float32), meaning)
