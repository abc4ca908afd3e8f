"""What rough mirrors see of all directions (T35), with its error against the whole sum (T09)."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from worker import layouts
from worker.images.image import Image
from worker.outcome import Outcome
from worker.synthesis import _pieces, _sphere, _spiral, _squares
from worker.synthesis._conversion import converted
from worker.synthesis._environment import taken
from worker.synthesis._lobes import SMOOTHEST, Lobe, ggx, phong
from worker.synthesis._prefilter import Cubes, Gatherer, probes

if TYPE_CHECKING:
    from collections.abc import Mapping

    from numpy.typing import NDArray

    from api_schemas.textures.prefiltered_environment import PrefilteredEnvironmentSpec
    from worker.stages import Report
    from worker.synthesis._sphere import Sphere

    Pixels = NDArray[np.float32]

_ROWS = 32
_PROBES = 24


def synthesize(
    spec: PrefilteredEnvironmentSpec,
    size: tuple[int, int],
    inputs: Mapping[str, Image],
    report: Report,
) -> Outcome:
    """Return the blurred light in the layout `to`, panel under panel: three channels of colour."""
    source, mended = taken(inputs["environment"], spec.layout, spec.broken_texels)
    lobes = _lobes(spec)
    blurring = [lobe for lobe in lobes if lobe.width > SMOOTHEST]
    cubes = Cubes(source, min(blurring, key=lambda lobe: lobe.width)) if blurring else None
    width, height = size
    pixels = np.zeros((height, width, 3), np.float32)
    errors: list[dict[str, Any]] = []
    top, panel = 0, (width, height if len(lobes) == 1 else height // 2)
    for index, lobe in enumerate(lobes):
        error: dict[str, Any] = {}
        columns, rows = (max(1, side >> index) for side in panel)
        if top + rows > height:
            break

        def told(share: float, step: str, done: int = index) -> None:
            report((done + share) / len(lobes), step)

        if cubes is None or lobe.width <= SMOOTHEST:
            shown = _mirrored(spec, source, (columns, rows), told)
        else:
            shown, error = _panel(spec, Gatherer(cubes, lobe), (columns, rows), told)
        pixels[top : top + rows, :columns] = shown
        errors.append(error)
        top += rows
    return Outcome(Image(pixels, "colour"), report={"panels": errors, **mended})


def warm() -> None:
    """Compile the kernels."""
    _sphere.warm()
    _spiral.warm()
    _pieces.warm()
    _squares.warm()


def _lobes(spec: PrefilteredEnvironmentSpec) -> list[Lobe]:
    if spec.exponents:
        return [phong(exponent) for exponent in spec.exponents]
    return [ggx(roughness) for roughness in spec.roughness]


def _mirrored(
    spec: PrefilteredEnvironmentSpec, source: Sphere, size: tuple[int, int], report: Report
) -> Pixels:
    pixels = converted(source, spec.to, size, report).sphere.pixels
    return pixels if spec.show == "light" else np.zeros_like(pixels)


def _panel(
    spec: PrefilteredEnvironmentSpec, gatherer: Gatherer, size: tuple[int, int], report: Report
) -> tuple[Pixels, dict[str, Any]]:
    """Return one picture, and what its error is in shares of the mean light."""
    width, height = size
    pixels = np.zeros((height, width, 3), np.float32)
    places = layouts.texel_middles(width, height).reshape(height, width, 2)
    for row in range(0, height, _ROWS):
        report(row / height, "gather")
        towards, valid = layouts.direction(spec.to, places[row : row + _ROWS].reshape(-1, 2))
        towards = np.ascontiguousarray(towards)
        if spec.method == "sum":
            light = gatherer.add_up(towards)
        else:
            light = gatherer.gather(towards.reshape(-1, width, 3)).reshape(-1, 3)
        if spec.show == "error":
            light = np.abs(light - gatherer.add_up(towards))
        rows = pixels[row : row + _ROWS]
        rows[:] = (light * valid[:, np.newaxis]).reshape(rows.shape)
    return pixels, {} if gatherer.narrow else _error(gatherer)


def _error(gatherer: Gatherer) -> dict[str, Any]:
    towards = probes(_PROBES)
    exact = gatherer.add_up(towards).astype(np.float64)
    error, mean = gatherer.gather(towards[np.newaxis])[0] - exact, exact.mean()
    if not mean > 0:
        return {}
    return {
        "error_rms": float(np.sqrt((error**2).mean()) / mean),
        "error_max": float(np.abs(error).max() / mean),
    }
