"""New texture out of old, seconds, medians of 3, compilation excluded.

Exemplars are cracked stones of our own, in three channels; the report on quality is included.
Doubling the sizes shows how the work grows. No other library here does the same.
"""

from collections.abc import Callable
from statistics import median
from time import perf_counter
from typing import Any

import numpy as np
from pydantic import TypeAdapter

from api_schemas.members import Texture
from worker.images.image import Image
from worker.stages import silent
from worker.synthesis import synthesize
from worker.synthesis.by_example.features import FeatureSpace
from worker.synthesis.by_example.field_search import quick_field

REPEATS = 3
TEXTURE = TypeAdapter(Texture)
STONES = {
    "technique": "ramp",
    "input": {"technique": "worley", "frequency": 9, "output": "difference", "seed": 3},
    "stops": [
        {"position": 0.02, "color": [0.01, 0.008, 0.005]},
        {"position": 0.18, "color": [0.3, 0.22, 0.15]},
        {"position": 0.6, "color": [0.62, 0.55, 0.45]},
    ],
}
WORK: list[tuple[str, int, int, dict[str, Any]]] = [
    ("ashikhmin", 128, 256, {}),
    ("ashikhmin", 128, 512, {}),
    ("ashikhmin", 256, 512, {}),
    ("wei_levoy", 64, 256, {"levels": 1, "neighbourhood": 4}),
    ("wei_levoy", 64, 256, {}),
    ("efros_leung", 64, 128, {}),
    ("image_quilting", 128, 512, {}),
    ("by_example_noise", 128, 512, {}),
    ("texture_optimization", 128, 256, {}),
    ("texture_optimization", 128, 512, {}),
    ("texture_optimization", 256, 512, {}),
    ("texture_optimization", 256, 1024, {}),
]


def measure() -> list[dict[str, Any]]:
    """Measure every technique, and a field of nearest patches."""
    rows = []
    for technique, side, grown, fields in WORK:
        body = {"technique": technique, "exemplar": STONES, "exemplar_size": [side, side]}
        spec = TEXTURE.validate_python({**body, "size": [grown, grown], **fields})
        seconds = typical(lambda spec=spec, size=(grown, grown): synthesize(spec, size, no_picture))
        options = ", ".join(f"{name} {value}" for name, value in fields.items())
        rows.append(row(f"{technique} {side}² to {grown}²", seconds, options))
    for side in (256, 512):
        target, source = (features(side, seed) for seed in (1, 2))
        everywhere = np.ones((side, side), bool)

        def five(target=target, source=source, everywhere=everywhere) -> None:
            passes = quick_field(target, source, everywhere, 7, 1)
            for _ in range(6):
                next(passes)

        rows.append(row(f"nearest neighbour field {side}², 7 x 7, 5 passes", typical(five), ""))
    return rows


def features(side: int, seed: int) -> np.ndarray:
    spec = TEXTURE.validate_python({**STONES, "input": {**STONES["input"], "seed": seed}})
    image: Image = synthesize(spec, (side, side), no_picture, report=silent)
    return FeatureSpace.of(image).encode(image)


def typical(work: Callable[[], object]) -> float:
    work()
    seconds = []
    for _ in range(REPEATS):
        start = perf_counter()
        work()
        seconds.append(perf_counter() - start)
    return median(seconds)


def row(work: str, seconds: float, note: str) -> dict[str, Any]:
    return {"work": work, "figure": round(seconds, 2), "unit": "s", "note": note}


def no_picture(spec: object, meaning: str) -> Image:
    raise AssertionError("nothing is uploaded")
