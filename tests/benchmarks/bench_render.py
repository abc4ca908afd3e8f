"""Rendering

A ball of 10000 triangles at 512 x 512 pixels, one sample each unless it says otherwise, and
Phong's terms mapped by distinct 1024 x 1024 pictures of noise. Medians of warm frames. First draws
and stock pyrender run in processes of their own, in the same run.
"""

import json
import os
import statistics
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Mapping
from pathlib import Path
from types import MappingProxyType
from typing import Any

import numpy as np

from api_schemas.families import Meaning, TextureSpec
from api_schemas.meshes import ModelMesh
from api_schemas.output import RenderOutput
from api_schemas.scene import Scene
from api_schemas.solid import worn_depth, worn_size
from api_schemas.textures.constant import ConstantSpec
from api_schemas.textures.image import ImageSpec
from worker.images.image import Image
from worker.images.volume import Volume
from worker.models.model import Model
from worker.rendering.texture_maker import TextureMaker

SIDE = 512
FRAMES = 9
SLOTS = (
    "diffuse_color",
    "emission",
    "specular_color",
    "ambient_color",
    "diffuse_weight",
    "specular_weight",
    "ambient_weight",
    "exponent",
)
"""What is mapped, in this order."""
RING = {"type": "torus", "radius": 0.8, "segments": 320, "rings": 160}
VARNISH = (
    "base_color",
    "metallic",
    "roughness",
    "occlusion",
    "emission",
    "specular",
    "specular_color",
    "clearcoat",
    "clearcoat_roughness",
)
GLASS = {"technique": "phong", "alpha_mode": "blend", "opacity": 0.5}


def measure() -> list[dict[str, object]]:
    """Measure this module's table."""
    base = frames_ms(maps=1)
    stock = in_child("stock")
    rows = [
        row("one base map, anisotropic", base, "ms", "wanted <= 25"),
        row("one base map, trilinear", frames_ms(maps=1, filter_name="trilinear"), "ms"),
        row("no map", frames_ms(maps=0), "ms"),
        row("one base map, 2 x 2 samples", frames_ms(maps=1, supersampling=2), "ms"),
        row("8 maps, anisotropic", frames_ms(maps=8), "ms", "wanted <= 90 for 12"),
        row("11 maps of metallic_roughness", median_ms(frame_of([varnished()])), "ms"),
        row("500 boxes of 500 colours", median_ms(frame_of(boxes())), "ms"),
        row("a million triangles", median_ms(frame_of([node(ball(1000, 501))])), "ms"),
        row("102000 triangles of glass", median_ms(frame_of([node(RING, GLASS)])), "ms"),
        row("stock pyrender, one base map", stock, "ms", "8 bits, 4 samples, trilinear"),
        row("stock pyrender / ours", stock / base, "x"),
    ]
    for maps in (1, 8):
        with tempfile.TemporaryDirectory() as folder:
            cold, warm = (in_child("first", str(maps), MESA_SHADER_CACHE_DIR=folder) for _ in "cw")
        rows += [
            row(f"first draw, {maps} maps, cold", cold, "ms", "wanted <= 120 per map"),
            row(f"first draw, {maps} maps, Mesa's cache", warm, "ms", "wanted <= 200"),
        ]
    return rows


def row(work: str, figure: float, unit: str, note: str = "") -> dict[str, object]:
    return {"work": work, "figure": round(figure, 1), "unit": unit, "note": note}


def in_child(*arguments: str, **environment: str) -> float:
    """Run this module as a program and read the figure that it prints."""
    finished = subprocess.run(
        [sys.executable, "-m", "tests.benchmarks.bench_render", *arguments],
        env=os.environ | {"PYTHONPATH": str(Path(__file__).parents[2])} | environment,
        stdout=subprocess.PIPE,
        check=True,
    )
    return float(json.loads(finished.stdout.splitlines()[-1]))


def frames_ms(maps: int, filter_name: str = "anisotropic", supersampling: int = 1) -> float:
    """Median time of a warm frame, from the request's scene to float pixels."""
    return median_ms(our_frame(maps, filter_name, supersampling))


def median_ms(frame: Callable[[], object]) -> float:
    """Draw twice to warm up, then take the median."""
    times = []
    for _ in range(FRAMES + 2):
        start = time.perf_counter()
        frame()
        times.append(1000 * (time.perf_counter() - start))
    return statistics.median(times[2:])


def our_frame(maps: int, filter_name: str, supersampling: int) -> Callable[[], object]:
    surface: dict[str, Any] = {"technique": "phong", "specular_weight": 0.3}
    for seed, name in enumerate(SLOTS[:maps]):
        texture = {"technique": "constant", "value": float(seed)}
        surface[name] = {"texture": texture, "filter": filter_name}
    return frame_of([node(ball(), surface)], supersampling)


def frame_of(
    nodes: list[dict[str, Any]], supersampling: int = 1, **scene_members: Any
) -> Callable[[], object]:
    """Return a function that draws the nodes, from the request's scene to float pixels.

    What else is named of the scene takes the place of its camera, its lights and so on.
    """
    # Imported late: a first draw is measured without it, and stock pyrender has its own context.
    from worker.rendering.renderer import render  # noqa: PLC0415

    scene = Scene.model_validate(
        {
            "camera": {"type": "perspective", "pose": {"eye": [0.0, 0.0, 2.8]}},
            "lights": [
                {"type": "ambient"},
                {"type": "directional", "direction": [1.0, -1.0, -1.0]},
            ],
            "nodes": nodes,
        }
        | scene_members
    )
    output = RenderOutput(size=[SIDE, SIDE], supersampling=supersampling)
    maker = TextureMaker(noise, solid, lambda spec, *, solid, meaning="colour": None)
    return lambda: list(render(scene, output, maker, no_model, lambda fraction, stage: None).bands)


def noise(
    spec: TextureSpec,
    meaning: Meaning,
    proportion: tuple[int, int] = (1, 1),
    rendered: Mapping[str, Image] = MappingProxyType({}),
    side: int = 1024,
) -> Image:
    """A picture per constant, whose value is the seed; other textures as they are."""
    if not isinstance(spec, ConstantSpec):
        from worker.synthesis import synthesize  # noqa: PLC0415  a first draw has none

        return synthesize(spec, worn_size(spec, proportion), no_picture, meaning)
    assert isinstance(spec.value, float)
    random = np.random.default_rng(int(spec.value))
    channels = 3 if meaning == "colour" else 1
    return Image(random.random((side, side, channels), dtype=np.float32), meaning)


def no_picture(spec: ImageSpec, meaning: Meaning) -> Image:
    """Fail: these scenes hold no uploads, and would not be what is measured."""
    raise AssertionError(f"a picture {spec.asset} in a scene without uploads")


def solid(spec: TextureSpec, meaning: Meaning) -> Volume:
    """A texture that fills space, as surfaces wear it."""
    from worker.synthesis import synthesize_volume  # noqa: PLC0415  a first draw has none

    return synthesize_volume(spec, (worn_depth(spec),) * 3, meaning)


def no_model(mesh: ModelMesh) -> Model:
    """Fail as `no_picture` does."""
    raise AssertionError(f"a model {mesh.asset} in a scene without uploads")


def ball(segments: int = 100, rings: int = 51) -> dict[str, object]:
    return {"type": "sphere", "segments": segments, "rings": rings}


def node(mesh: dict[str, object], surface: dict[str, Any] | None = None) -> dict[str, Any]:
    return {"mesh": mesh, "surface": surface}


def varnished() -> dict[str, Any]:
    """A ball of which every term is mapped."""
    names = (*VARNISH, "opacity", "normal")
    maps = {
        name: {"texture": {"technique": "constant", "value": float(100 + seed)}}
        for seed, name in enumerate(names)
    }
    return node(ball(), {"technique": "metallic_roughness", "alpha_mode": "mask", **maps})


def boxes() -> list[dict[str, Any]]:
    box: dict[str, object] = {"type": "box", "width": 0.05, "height": 0.05, "depth": 0.05}
    return [
        node(box, {"technique": "phong", "diffuse_color": [index / 500, 0.5, 0.5]})
        | {"transform": {"translation": [index % 25 / 12 - 1, index // 25 / 10 - 1, 0.0]}}
        for index in range(500)
    ]


def first_draw_ms(maps: int) -> float:
    """Linking and first drawing of a program with so many maps in this fresh process."""
    our_frame(0, "nearest", 1)()  # opens the context
    from worker.rendering.renderer import _engine  # noqa: PLC0415

    before = _engine().renderer.jit_seconds
    our_frame(maps, "anisotropic", 1)()
    return 1000 * (_engine().renderer.jit_seconds - before)


def stock_ms() -> float:
    """The same ball drawn by pyrender as it comes."""
    import pyrender  # noqa: PLC0415  needs no engine of ours, and must not meet its state

    from api_schemas.meshes import Sphere  # noqa: PLC0415
    from tests.opengl_probe import Platform  # noqa: PLC0415
    from worker.geometry.primitives import build  # noqa: PLC0415

    platform = Platform(16, 16)
    platform.init_context()
    platform.make_current()
    mesh = build(Sphere.model_validate(ball()))
    picture = np.random.default_rng(0).integers(0, 256, (1024, 1024, 3), dtype=np.uint8)
    material = pyrender.MetallicRoughnessMaterial(
        baseColorTexture=pyrender.Texture(source=picture, source_channels="RGB"),
        metallicFactor=0.0,
    )
    scene = pyrender.Scene(ambient_light=np.full(3, 0.1))
    scene.add(
        pyrender.Mesh(
            [
                pyrender.Primitive(
                    positions=mesh.positions,
                    normals=mesh.normals,
                    texcoord_0=mesh.uv(),
                    indices=mesh.triangles,
                    material=material,
                )
            ]
        )
    )
    pose = np.eye(4)
    pose[2, 3] = 2.8
    scene.add(pyrender.PerspectiveCamera(yfov=0.8, aspectRatio=1.0), pose=pose)
    scene.add(pyrender.DirectionalLight(intensity=3.0), pose=pose)
    renderer = pyrender.Renderer(SIDE, SIDE)
    return median_ms(lambda: renderer.render(scene, pyrender.RenderFlags.OFFSCREEN))


if __name__ == "__main__":
    match sys.argv[1:]:
        case ["stock"]:
            print(json.dumps(stock_ms()))
        case ["first", count]:
            print(json.dumps(first_draw_ms(int(count))))
