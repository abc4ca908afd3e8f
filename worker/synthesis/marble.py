"""Waves bent by turbulence (Perlin, 1985): marble(p) = sin(veins . p + turbulence(p)).

The wave is averaged over the pixel as if nothing bent it: what is left of a cosine is a sinc along
each side.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from worker.images.image import Image
from worker.images.volume import Volume
from worker.numba_kernel import parallel_kernel, prange

if TYPE_CHECKING:
    from collections.abc import Mapping

    from numpy.typing import NDArray

    from api_schemas.textures.marble import MarbleSpec
    from worker.closed_form import Parameter
    from worker.stages import Report

    Numbers = NDArray[np.float64]


def synthesize(
    spec: MarbleSpec, size: tuple[int, int], inputs: Mapping[str, Image], report: Report
) -> Image:
    """Bend waves by `inputs["turbulence"]`: one channel of data."""
    width, height = size
    bent = inputs["turbulence"].pixels[np.newaxis, ..., 0]
    return Image(_slices(spec, (width, height, 0), np.array(bent))[0], spec.meaning)


def synthesize_volume(
    spec: MarbleSpec, size: tuple[int, int, int], inputs: Mapping[str, Volume], report: Report
) -> Volume:
    """Bend waves in space by `inputs["turbulence"]`: one channel of data."""
    bent = np.array(inputs["turbulence"].voxels[..., 0])
    return Volume(_slices(spec, size, bent), spec.meaning)


def marble_at(spec: MarbleSpec, places: Numbers, turbulence: Numbers, sides: Numbers) -> Numbers:
    """Return values (n,) at points with given turbulence (n,), averaged over parallelograms.

    Args:
        spec: The waves.
        places: Of the plane (n, 2) or of space (n, 3), in tiles.
        turbulence: At these places.
        sides: Of every parallelogram or box, (sides, 2) or (sides, 3), in tiles.
    """
    veins = np.array(_veins(spec))[: places.shape[1]]
    scale, bias = _scale_and_bias(spec)
    angles = 2 * np.pi * (places @ veins) + spec.strength * (turbulence - spec.rest)
    values: Numbers = scale * np.sinc(sides @ veins).prod() * np.sin(angles) + bias
    return values


def closed_form(spec: MarbleSpec, *, solid: bool) -> Mapping[str, Parameter]:
    """Return the waves; the turbulence is the input."""
    scale, bias = _scale_and_bias(spec)
    veins = np.array(_veins(spec), np.float32) * (1, 1, solid)
    return {
        "veins": veins,
        "strength": spec.strength,
        "rest": spec.rest,
        "scale": scale,
        "bias": bias,
    }


def warm() -> None:
    """Compile the kernel."""
    angle = np.zeros(1)
    _fill_waves(np.empty((1, 1, 1), np.float32), angle, angle, angle, 0.0, 0.0, 1.0, 0.0)


def _slices(
    spec: MarbleSpec, size: tuple[int, int, int], bent: NDArray[np.float32]
) -> NDArray[np.float32]:
    """Return (depth, height, width, 1); no depth means the plane w = 0."""
    width, height, depth = size
    veins = _veins(spec)
    columns = _angles(veins[0], np.arange(width), width)
    rows = _angles(veins[1], np.arange(height)[::-1], height)
    away = _angles(veins[2], np.arange(depth), depth) if depth else np.zeros(1)
    counts = np.array([width, height, depth]) if depth else np.array([width, height])
    scale, bias = _scale_and_bias(spec)
    fade = np.sinc(np.array(veins)[: len(counts)] / counts).prod()
    values = bent.copy()
    _fill_waves(values, columns, rows, away, spec.strength, spec.rest, scale * fade, bias)
    return values[..., np.newaxis]


def _veins(spec: MarbleSpec) -> tuple[int, int, int]:
    u, v, w = [*spec.veins, 0][:3]
    return u, v, w


def _scale_and_bias(spec: MarbleSpec) -> tuple[float, float]:
    return (0.5, 0.5) if spec.range == "unit" else (1.0, 0.0)


def _angles(veins: int, index: NDArray[np.int64], pixels: int) -> Numbers:
    """Return the angles at pixel centres, from whole numbers, so that they repeat bit for bit."""
    turns = veins * (2 * index + 1) % (2 * pixels)
    return turns.astype(np.float64) * (np.pi / pixels)


@parallel_kernel
def _fill_waves(
    values: NDArray[np.float32],
    columns: Numbers,
    rows: Numbers,
    away: Numbers,
    strength: float,
    rest: float,
    scale: float,
    bias: float,
) -> None:
    """Replace what bends the waves, (depth, height, width), by the waves."""
    depth, height, width = values.shape
    for line in prange(depth * height):
        row = values[line // height, line % height]
        start = rows[line % height] + away[line // height] - strength * rest
        for column in range(width):
            row[column] = scale * np.sin(columns[column] + start + strength * row[column]) + bias
