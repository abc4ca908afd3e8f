"""Memory of a process that draws one new scene after another

Each scene has a ball, a texture and a normal map of 512 x 512 that were never seen before. What is
held for later has a bound, so the memory comes to a rest.
"""

import functools
import itertools
import json
import os
import subprocess
import sys
from pathlib import Path
from typing import Any

from tests.benchmarks.bench_render import no_model, noise, row
from worker.jobs.heap import Heap, resident_bytes

AT = (100, 250, 500, 1000)
"""Scenes after which the memory is looked at."""


def measure() -> list[dict[str, object]]:
    """Measure this module's table in a process of its own."""
    finished = subprocess.run(
        [sys.executable, "-m", "tests.benchmarks.bench_memory"],
        env=os.environ | {"PYTHONPATH": str(Path(__file__).parents[2])},
        stdout=subprocess.PIPE,
        check=True,
    )
    megabytes = json.loads(finished.stdout.splitlines()[-1])
    rows = [
        row(f"after {count} new scenes", held, "MB")
        for count, held in zip(AT, megabytes, strict=True)
    ]
    growth = 100 * (megabytes[-1] / megabytes[-2] - 1)
    return [*rows, row("from the 500th to the 1000th", growth, "%", "wanted < 5")]


def held_megabytes() -> list[float]:
    """Draw scenes, and look at the resident memory now and then."""
    from api_schemas.output import RenderOutput  # noqa: PLC0415  beside the renderer
    from worker.rendering.renderer import render  # noqa: PLC0415  opens a context

    output = RenderOutput(size=[128, 128], supersampling=1)
    pictures = functools.partial(noise, side=512)
    found = []
    heap = Heap()
    for count in itertools.count(1):
        rendering = render(new_scene(count), output, pictures, no_model, lambda share, stage: None)
        list(rendering.bands)
        heap.tidy()  # as a worker does between jobs
        if count in AT:
            found.append(resident_bytes() / 1e6)
        if count == AT[-1]:
            return found
    raise AssertionError


def new_scene(number: int) -> Any:
    """Return a scene whose mesh and pictures depend on its number."""
    from api_schemas.scene import Scene  # noqa: PLC0415  beside the renderer

    def picture(seed: int) -> dict[str, Any]:
        return {"texture": {"technique": "constant", "value": float(seed)}}

    surface = {
        "technique": "metallic_roughness",
        "base_color": picture(2 * number),
        "normal": picture(2 * number + 1),
    }
    ball = {"type": "sphere", "radius": 1 + number * 1e-4}
    return Scene.model_validate({"nodes": [{"mesh": ball, "surface": surface}]})


if __name__ == "__main__":
    print(json.dumps(held_megabytes()))
