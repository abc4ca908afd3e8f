"""Perlin noise in pictures, solids and time, summed over octaves (Perlin, 1985 and 2002).

A function on the unit tile: octave n has frequency * lacunarity^n lattice cells along each side,
and as many as its period, so the tile joins itself without a seam; in time it has as many times
`beats`. Which gradients:

- "eight": unit vectors 45 degrees apart; |noise| <= sqrt(1/2), reached at the centre of a cell.
- "reference": Perlin's sixteen without their z; |noise| <= 1. With seed 0 a single octave is the
  slice z = 0 of the noise of 2002 in all cells but those that join the tile's ends, and at
  frequency 256 in those too.
- Solids, and pictures cut from them, have the sixteen whole, |noise| <= 1.0364; what changes in
  time has the 32 edges of a hypercube.

Lattice indices count modulo 256 after the period: with more cells the pattern comes again.

`range: unit` brings the sum n of octaves to (n + 1)/2, billow to what turbulence is, and the
product of a multifractal, divided by its largest value, below 1.
"""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING

import numpy as np

from api_schemas.textures.perlin import PerlinSpec
from worker.images.image import Image
from worker.images.volume import Volume
from worker.stages import silent
from worker.synthesis._perlin_grid import axis_table, fill_fractal_noise
from worker.synthesis._perlin_octaves import octaves_of
from worker.synthesis._perlin_points import FADES, GRADIENTS
from worker.synthesis._perlin_solid import fill_fractal_solid, place_table
from worker.synthesis._perlin_sums import fill_noise_at, fold, folding, octave_table
from worker.synthesis._permutation import permutation

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence

    from numpy.typing import NDArray

    from worker.closed_form import Parameter
    from worker.stages import Report
    from worker.synthesis._perlin_octaves import Octave

    Floats = NDArray[np.float32]
    Fill = Callable[[Floats, Sequence[Octave], Floats, np.float32], None]

_AXES = {"eight": 2, "reference": 2, "solid": 3, "time": 4}


def synthesize(
    spec: PerlinSpec, size: tuple[int, int], inputs: Mapping[str, Image], report: Report
) -> Image:
    """Rasterise the tile at (width, height): one channel of data, within 2e-6 of `noise_at`.

    Slopes are those of `noise_at` themselves.
    """
    width, height = size
    if spec.output == "slope":
        return Image(_slopes(spec, (height, width), min(size)), spec.meaning)
    pixels = np.empty((height, width), np.float32)
    octaves = octaves_of(spec, min(size))
    gradients = _gradients(spec, solid=False)
    if _AXES[gradients] == 2:
        _add_up(spec, gradients, octaves, pixels, partial(_fill_picture, spec))
    else:
        fill = partial(_fill_solid, spec, gradients, spec.depth or 0.0)
        _add_up(spec, gradients, octaves, pixels[np.newaxis], fill)
    return Image(pixels[..., np.newaxis], spec.meaning)


def synthesize_volume(
    spec: PerlinSpec, size: tuple[int, int, int], inputs: Mapping[str, Volume], report: Report
) -> Volume:
    """Rasterise the solid tile at (width, height, depth) in the same way."""
    if spec.output == "slope":
        return Volume(_slopes(spec, size[::-1], min(size)), spec.meaning)
    voxels = np.empty(size[::-1], np.float32)
    gradients = _gradients(spec, solid=True)
    fill = partial(_fill_solid, spec, gradients, None)
    _add_up(spec, gradients, octaves_of(spec, min(size)), voxels, fill)
    return Volume(voxels[..., np.newaxis], spec.meaning)


def noise_at(
    spec: PerlinSpec, places: NDArray[np.float64], pixels_per_tile: float = np.inf
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Evaluate the same noise in float64 at points of the plane or of space.

    Args:
        spec: The noise.
        places: (n, 2) of its picture, (n, 3) of its solid, in tiles.
        pixels_per_tile: Decides which octaves have faded, as the size does for a picture.

    Returns:
        Values (n,), and what they grow by along each axis, per tile, (n, 2) or (n, 3).
    """
    count, axes = places.shape
    gradients = _gradients(spec, solid=axes == 3)
    where = np.zeros((count, 4))
    where[:, 2] = spec.depth or 0.0
    where[:, :axes] = places
    where[:, 3] = (spec.time or 0.0) % 1
    values, slopes = np.empty(count), np.empty((count, 4))
    how = folding(spec, gradients)
    fill_noise_at(
        values,
        slopes,
        where,
        _AXES[gradients],
        octave_table(octaves_of(spec, pixels_per_tile), how),
        how,
        permutation(spec.seed),
        GRADIENTS[gradients],
        FADES[spec.fade],
    )
    return values, slopes[:, :axes]


def closed_form(spec: PerlinSpec, *, solid: bool) -> Mapping[str, Parameter] | None:
    """Return what makes the octaves and brings them together; slopes have no formula."""
    if spec.output == "slope":
        return None
    gradients = _gradients(spec, solid=solid)
    octaves = octaves_of(spec, np.inf)
    how = folding(spec, gradients)
    moments = [_moment(spec, octave.beats) for octave in octaves]
    first = octaves[0]
    return {
        "table": permutation(spec.seed).reshape(64, 4).astype(np.float32),
        "fade": FADES[spec.fade].astype(np.float32),
        "set": list(GRADIENTS).index(gradients),
        "kind": how.kind,
        "octaves": len(octaves),
        "frequency": spec.frequency,
        "lacunarity": spec.lacunarity,
        "gain": spec.gain,
        "share": first.gain if spec.sum == "multifractal" else first.share,
        "depth": 0.0 if solid else (spec.depth or 0.0) % 1,
        "moments": np.array(moments, np.float32),
        "start": how.start,
        "rest": how.rest,
        "scale": how.scale,
        "bias": how.bias,
    }


def warm() -> None:
    """Compile the kernels."""
    spec = PerlinSpec(technique="perlin", frequency=1)
    synthesize(spec, (4, 4), {}, silent)
    synthesize(spec.model_copy(update={"sum": "ridged"}), (4, 4), {}, silent)
    synthesize(spec.model_copy(update={"output": "slope"}), (4, 4), {}, silent)
    synthesize_volume(spec, (4, 4, 4), {}, silent)


def _moment(spec: PerlinSpec, beats: int) -> tuple[int, int, float]:
    """Return the lattice indices before and after the time asked, and the part between them."""
    part, whole = np.modf((spec.time or 0.0) % 1 * beats)
    return int(whole) % beats % 256, (int(whole) + 1) % beats % 256, float(part)


def _slopes(spec: PerlinSpec, shape: tuple[int, ...], pixels_per_tile: int) -> Floats:
    """Return slopes at the centres of (height, width) pixels or (depth, height, width) voxels."""
    centres = [(np.arange(count) + 0.5) / count for count in shape]
    centres[-2] = centres[-2][::-1]
    slopes = np.empty((*shape, len(shape)), np.float32)
    # Row by row of a picture, slice by slice of a solid, which keeps the points few
    for index, first in enumerate(centres[0]):
        rest = np.stack(np.meshgrid(first, *centres[1:], indexing="ij")[::-1], axis=-1)
        _, found = noise_at(spec, rest.reshape(-1, len(shape)), pixels_per_tile)
        slopes[index] = found.reshape(slopes[index].shape)
    return slopes


def _gradients(spec: PerlinSpec, *, solid: bool) -> str:
    if spec.time is not None:
        return "time"
    return "solid" if solid or spec.depth is not None else spec.gradients


def _add_up(
    spec: PerlinSpec, gradients: str, octaves: Sequence[Octave], values: Floats, fill: Fill
) -> None:
    """Write the sum of octaves that `fill` writes one or, if they are just added, all of."""
    how = folding(spec, gradients)
    one, nothing = np.ones(1, np.float32), np.float32(0)
    if how.kind:
        fold(values, octaves, how, lambda noise, octave: fill(noise, [octave], one, nothing))
        return
    visible = [octave for octave in octaves if octave.weight > 0]
    if not visible:
        values.fill(how.bias)
        return
    weights = np.array([octave.weight * how.scale for octave in visible], np.float32)
    fill(values, visible, weights, np.float32(how.bias))


def _fill_picture(
    spec: PerlinSpec, pixels: Floats, octaves: Sequence[Octave], weights: Floats, bias: np.float32
) -> None:
    height, width = pixels.shape
    fade = FADES[spec.fade]
    fill_fractal_noise(
        pixels,
        axis_table(octaves, 0, np.arange(width), width, fade),
        axis_table(octaves, 1, np.arange(height), height, fade),
        np.array([octave.layer for octave in octaves], np.int32),
        np.array([octave.cells for octave in octaves], np.int32),
        weights,
        bias,
        permutation(spec.seed),
        GRADIENTS[spec.gradients].astype(np.float32),
    )


def _fill_solid(
    spec: PerlinSpec,
    gradients: str,
    cut: float | None,
    voxels: Floats,
    octaves: Sequence[Octave],
    weights: Floats,
    bias: np.float32,
) -> None:
    """Fill (depth, height, width), or the single slice that lies at `cut`."""
    depth, height, width = voxels.shape
    fade = FADES[spec.fade]
    cells = [octave.cells for octave in octaves]
    beats = [octave.beats for octave in octaves]
    fill_fractal_solid(
        voxels,
        axis_table(octaves, 0, np.arange(width), width, fade),
        axis_table(octaves, 1, np.arange(height), height, fade),
        axis_table(octaves, 2, np.arange(depth), depth, fade)
        if cut is None
        else place_table(cut, cells, fade),
        place_table(spec.time or 0.0, beats, fade),
        np.array([octave.layer for octave in octaves], np.int32),
        np.array(cells, np.int32),
        np.array(beats, np.int32),
        weights,
        bias,
        permutation(spec.seed),
        GRADIENTS[gradients].astype(np.float32),
    )
