"""Perlin noise in two dimensions, summed over octaves (Perlin, 1985; improved noise, 2002).

A function on the unit tile: octave n has frequency * lacunarity^n lattice cells along u and along
v, and as many as its period, so the tile joins itself without a seam. Which gradients:

- "eight": unit vectors 45 degrees apart; |noise| <= sqrt(1/2), reached at the centre of a cell.
- "reference": Perlin's sixteen without their z; |noise| <= 1. With seed 0 a single octave is the
  slice z = 0 of the noise of 2002 in all cells but those that join the tile's ends, and at
  frequency 256 in those too.

Lattice indices count modulo 256 after the period: with more cells the pattern comes again.

`range: signed` gives the weighted sum n itself, `range: unit` gives (n + 1)/2.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from api_schemas.textures.perlin import PerlinSpec
from worker.images.image import Image
from worker.stages import silent
from worker.synthesis._perlin_grid import axis_table, fill_fractal_noise
from worker.synthesis._perlin_octaves import SHIFT_UNITS, octaves_of
from worker.synthesis._perlin_points import FADES, GRADIENTS_2D, fill_fractal_noise_at
from worker.synthesis._permutation import permutation

if TYPE_CHECKING:
    from collections.abc import Mapping

    from numpy.typing import NDArray

    from worker.stages import Report


def synthesize(
    spec: PerlinSpec, size: tuple[int, int], inputs: Mapping[str, Image], report: Report
) -> Image:
    """Rasterise the tile at (width, height): one channel of data, within 2e-6 of `noise_at`."""
    width, height = size
    pixels = np.empty((height, width), np.float32)
    scale, bias = _scale_and_bias(spec)
    octaves = octaves_of(spec, min(size))
    if not octaves:
        pixels.fill(bias)
        return Image(pixels[..., np.newaxis], spec.meaning)
    fade = FADES[spec.fade]
    fill_fractal_noise(
        pixels,
        axis_table(octaves, 0, np.arange(width), width, fade),
        axis_table(octaves, 1, np.arange(height), height, fade),
        np.array([octave.layer for octave in octaves], np.int32),
        np.array([octave.cells for octave in octaves], np.int32),
        np.array([octave.weight * scale for octave in octaves], np.float32),
        np.float32(bias),
        permutation(spec.seed),
        GRADIENTS_2D[spec.gradients].astype(np.float32),
    )
    return Image(pixels[..., np.newaxis], spec.meaning)


def noise_at(
    spec: PerlinSpec,
    u: NDArray[np.float64],
    v: NDArray[np.float64],
    pixels_per_tile: float = np.inf,
) -> NDArray[np.float64]:
    """Evaluate the same noise in float64 at points of the plane, given as two flat arrays.

    `pixels_per_tile` decides which octaves have faded, as the size does for a picture.
    """
    octaves = [
        (octave.cells, octave.weight, octave.layer, *np.divide(octave.shift, SHIFT_UNITS))
        for octave in octaves_of(spec, pixels_per_tile)
    ]
    values = np.empty(len(u))
    fill_fractal_noise_at(
        values,
        np.array(u, np.float64),
        np.array(v, np.float64),
        np.array(octaves, np.float64).reshape(-1, 5),
        permutation(spec.seed),
        GRADIENTS_2D[spec.gradients],
        FADES[spec.fade],
    )
    scale, bias = _scale_and_bias(spec)
    return values * scale + bias


def warm() -> None:
    """Compile the kernel of pictures; points are for tests and compile when asked for."""
    synthesize(PerlinSpec(technique="perlin", frequency=1), (4, 4), {}, silent)


def _scale_and_bias(spec: PerlinSpec) -> tuple[float, float]:
    return (0.5, 0.5) if spec.range == "unit" else (1.0, 0.0)
