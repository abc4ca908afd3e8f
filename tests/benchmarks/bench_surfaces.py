"""Surfaces, shadows and environments, for a million pixels

A square that fills 512 x 512 pixels of one sample, its colour a picture of 1024 x 1024 texels, lit
by a lamp and an even sky; `unlit` shows the picture alone. What is streaked has a roughness of .4
and an `anisotropy_strength` of .5; bumps are a picture of tilts. A `volume` fills a box behind the
whole picture, in 16 steps. Shadows are those of a ball on a floor, through maps as they come, which
are drawn anew in each frame. All scenes take turns; figures are medians of warm frames. What an
environment needs once is a row of its own.
"""

import statistics
import time
from collections.abc import Callable, Mapping
from typing import Any

from tests.benchmarks.bench_render import SIDE, ball, frame_of, node

TURNS = 7
COLORS = {
    "unlit": "color",
    "phong": "diffuse_color",
    "metallic_roughness": "base_color",
    "brushed_metal": "diffuse_color",
    "ward": "diffuse_color",
    "ashikhmin_shirley": "diffuse_color",
    "glass": "color",
}
"""Each surface's own parameter for the picture, that of the plain one first."""
BUMPS: dict[str, Any] = {"texture": {"technique": "constant", "value": 2.0}}
METALS: dict[str, tuple[dict[str, Any], str]] = {
    "metallic_roughness, streaked": (
        {"roughness": 0.4, "anisotropy_strength": 0.5},
        "metallic_roughness",
    ),
    "metallic_roughness, bumps": ({"bump": BUMPS}, "metallic_roughness"),
    "metallic_roughness, bumps as roughness": (
        {"bump": BUMPS | {"fine_detail": "roughness"}},
        "metallic_roughness, bumps",
    ),
    "metallic_roughness, bumps as streaks": (
        {"bump": BUMPS | {"fine_detail": "streaks"}},
        "metallic_roughness, bumps",
    ),
}
"""Parameters of metal, and what it is compared with."""
CLOUD: dict[str, Any] = {"texture": {"technique": "perlin", "frequency": 4}, "bias": 0.3}
VOLUMES: dict[str, tuple[dict[str, Any], str]] = {
    "volume, even": ({"light_steps": 0}, "nothing"),
    "volume, of noise": ({"density": CLOUD, "light_steps": 0}, "volume, even"),
    "volume, of noise that shades itself": (
        {"density": CLOUD, "light_steps": 8},
        "volume, of noise",
    ),
}
"""The same of what fills a box."""
LAMPS: dict[str, dict[str, Any]] = {
    "directional": {"type": "directional", "direction": [-0.3, -1.0, -0.4]},
    "spot": {"type": "spot", "position": [0.6, 2.0, 0.8], "direction": [-0.3, -1.0, -0.4]},
    "point": {"type": "point", "position": [0.6, 2.0, 0.8]},
}
FACING = {"type": "orthographic", "height": 2.0, "pose": {"eye": [0.0, 0.0, 2.0]}}
BEFORE = FACING | {"pose": {"eye": [0.0, 0.0, 4.0]}}
LANTERN = {"texture": {"technique": "constant", "value": 3.0}}
Frame = Callable[[], object]


def measure() -> list[dict[str, object]]:
    """Measure this module's table."""
    frame_of([], camera=FACING, environment=noisy(5))()  # compiles what makes environments
    start = time.perf_counter()
    frame_of([], camera=FACING, environment=noisy(8))()
    once = 1000 * (time.perf_counter() - start)
    bases: dict[str, str] = {}
    frames: dict[str, Frame] = {"nothing": frame_of([], camera=FACING)}
    for technique in COLORS:
        frames[technique] = frame_of([square(technique)], camera=FACING)
        bases[technique] = "unlit"
    for technique in COLORS:
        name = f"{technique}, in an environment"
        unseen = noisy(8) | {"visible": False}
        frames[name] = frame_of([square(technique)], camera=FACING, environment=unseen)
        bases[name] = technique
    for name, (more, base) in METALS.items():
        frames[name] = frame_of([square("metallic_roughness", **more)], camera=FACING)
        bases[name] = base
    name = "metallic_roughness, streaked, in an environment"
    streaked, _ = METALS[base := "metallic_roughness, streaked"]
    worn, unseen = square("metallic_roughness", **streaked), noisy(8) | {"visible": False}
    frames[name], bases[name] = frame_of([worn], camera=FACING, environment=unseen), base
    box = {"type": "box", "width": 2.0, "height": 2.0, "depth": 2.0}
    for name, (more, base) in VOLUMES.items():
        frames[name] = frame_of(
            [node(box, {"technique": "volume", "steps": 16, **more})], camera=BEFORE
        )
        bases[name] = base
    name = "an environment behind everything"
    frames[name], bases[name] = frame_of([], camera=FACING, environment=noisy(8)), "nothing"
    for kind, lamp in LAMPS.items():
        base, name = f"a ball on a floor, {kind} light", f"the same with its shadow, {kind}"
        frames[base] = frame_of(floor(), lights=[lamp])
        frames[name] = frame_of(floor(), lights=[lamp | {"shadow": {}}])
        bases[name] = base
    base, name = "a ball on a floor, point light", "the same through a lantern"
    frames[name] = frame_of(floor(), lights=[LAMPS["point"] | {"cookie": LANTERN}])
    bases[name] = base
    taken = timed(frames)
    rows: list[dict[str, object]] = [
        {"work": "an environment, made once", "frame, ms": round(once, 1)}
    ]
    for name, seconds in taken.items():
        base = bases.get(name, name)
        more = "" if base == name else per_megapixel(seconds - taken[base])
        rows.append(
            {
                "work": name,
                "frame, ms": round(1000 * seconds, 1),
                "ms per megapixel": per_megapixel(seconds),
                "more, ms per megapixel": more,
                "than": "" if base == name else base,
            }
        )
    return rows


def timed(frames: Mapping[str, Frame]) -> dict[str, float]:
    """Return the median seconds of each frame, all drawn in turns after a first one each."""
    times: dict[str, list[float]] = {name: [] for name in frames}
    for _ in range(TURNS + 1):
        for name, frame in frames.items():
            start = time.perf_counter()
            frame()
            times[name].append(time.perf_counter() - start)
    return {name: statistics.median(taken[1:]) for name, taken in times.items()}


def per_megapixel(seconds: float) -> float:
    return round(1000 * seconds * 1e6 / SIDE**2, 1)


def square(technique: str, **more: Any) -> dict[str, Any]:
    """What fills the picture, its colour a picture of noise that all of them share."""
    color = {"texture": {"technique": "constant", "value": 1.0}}
    return node({"type": "plane"}, {"technique": technique, COLORS[technique]: color, **more})


def noisy(frequency: int) -> dict[str, Any]:
    """An environment of noise, in latitude and longitude."""
    return {"texture": {"technique": "perlin", "frequency": frequency}}


def floor() -> list[dict[str, Any]]:
    """A ball that casts a shadow on a square, which the camera of the benchmarks looks down on."""
    lying = {"rotation": [-0.5, 0.0, 0.0, 0.75**0.5], "translation": [0.0, -0.6, -0.4]}
    return [
        node(ball()) | {"transform": {"scale": [0.5, 0.5, 0.5]}},
        node({"type": "plane", "width": 6.0, "height": 6.0}) | {"transform": lying},
    ]
