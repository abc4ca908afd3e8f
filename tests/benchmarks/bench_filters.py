"""Filters of textures on the checkered plane to the horizon

The plane of squares that T39 describes, 512 x 512 pixels of one sample: what each filter costs for
a million pixels of the plane beside a plain colour's, and how far its picture is from the mean
over each pixel (RMS, squares 1 and 0). `Worked out` are textures evaluated at every pixel.
"""

import json
import statistics
import time
from typing import Any

import numpy as np

from api_schemas.output import RenderOutput
from api_schemas.scene import Scene
from tests.checkered_plane import FILTERS, SIDE, exact_plane, plane_scene, rms, squares
from tests.worker.rendering.studio import Studio

FRAMES = 7
COLORS = [[1.0, 1.0, 1.0], [0.0, 0.0, 0.0]]
WINDOWS = ("truncated", "fejer", "lanczos", "gaussian")
PIXEL_FILTERS = ("box", "tent", "gaussian")


def measure() -> list[dict[str, object]]:
    """Measure this module's table."""
    from worker.rendering.renderer import render  # noqa: PLC0415  opens OpenGL

    studio = Studio(render)
    texture = studio.texture(squares())
    exact = exact_plane()
    plain, _ = timed(studio, [1.0, 1.0, 1.0])
    rows = [row("a plain colour", plain, 0.0, None)]
    maps = [(name, {"texture": texture, "filter": name}) for name in FILTERS]
    maps += [
        (f"{name}, Kaiser", {"texture": texture, "filter": name, "pyramid": "kaiser"})
        for name in ("trilinear", "ewa", "anisotropic")
    ]
    board = {"cells": [2, 2], "colors": COLORS}
    formulas = {"box": {"technique": "checkerboard"} | board}
    for window in WINDOWS:
        formulas[window] = {"technique": "band_limited_checkerboard", "window": window} | board
    maps += [
        (f"worked out, {name}", {"texture": formula, "filter": "formula"})
        for name, formula in formulas.items()
    ]
    for name, mapped in maps:
        seconds, picture = timed(studio, mapped)
        rows.append(row(name, seconds, seconds - plain, rms(picture, exact)))
    for pixel_filter in PIXEL_FILTERS:
        output = {"supersampling": 4, "pixel_filter": pixel_filter}
        seconds, picture = timed(studio, maps[0][1], **output)
        rows.append(
            row(f"nearest, 4 x 4 samples, {pixel_filter}", seconds, None, rms(picture, exact))
        )
    return rows


def row(work: str, seconds: float, more: float | None, off: float | None) -> dict[str, object]:
    million = 1000 * 1e6 / (SIDE * SIDE / 2)
    return {
        "work": work,
        "frame, ms": round(1000 * seconds, 1),
        "more than plain, ms per megapixel": "" if more is None else round(million * more, 1),
        "RMS": "" if off is None else f"{off:.4f}",
    }


def timed(studio: Studio, color: Any, **output: Any) -> tuple[float, np.ndarray]:
    """Return the median seconds of a warm frame, and its picture."""
    scene = Scene.model_validate_json(json.dumps(plane_scene(color)))
    wanted = RenderOutput(**({"size": [SIDE, SIDE], "supersampling": 1} | output))
    times, picture = [], np.empty(0)
    for _ in range(FRAMES + 1):
        start = time.perf_counter()
        bands = list(
            studio._render(scene, wanted, studio.maker, None, lambda share, stage: None).bands
        )
        times.append(time.perf_counter() - start)
        picture = np.concatenate([band["picture"].pixels for band in bands])
    return statistics.median(times[1:]), picture
