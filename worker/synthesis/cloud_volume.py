"""A solid density looked through along w: extinction after Beer and Lambert, one scattering.

Slices are taken from the front to the back; each is looked at through those before it. A slice's
own extinction is exact for a density that is constant within it. Shadows sum the density above, up
to their reach, and come in again at the bottom where they leave at the top, so the tile repeats.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from worker import synthesis
from worker.images.image import Image

if TYPE_CHECKING:
    from collections.abc import Mapping

    from numpy.typing import NDArray

    from api_schemas.textures.cloud_volume import CloudVolumeSpec
    from worker.stages import Report

    Numbers = NDArray[np.float64]

_MAKING = 0.5
"""Share of the work that is making the density."""


def synthesize(
    spec: CloudVolumeSpec, size: tuple[int, int], inputs: Mapping[str, Image], report: Report
) -> Image:
    """Look through the density, made at (width, height, steps)."""
    width, height = size
    volume = synthesis.synthesize_volume(
        spec.density,
        (width, height, spec.steps),
        "data",
        lambda share, step: report(_MAKING * share, step),
    )
    depth = np.zeros((height, width))
    light = np.zeros((height, width, 3))
    lit, dark = np.array(spec.lit), np.array(spec.dark)
    for index in range(spec.steps):
        report(_MAKING + (1 - _MAKING) * index / spec.steps, "looking through")
        density = volume.voxels[index, ..., 0].astype(np.float64).clip(0, None)
        own = spec.extinction / spec.steps * density
        if spec.show == "cloud":
            seen = np.exp(-depth) - np.exp(-depth - own)
            bright = np.exp(-spec.shade * _above(density, spec.reach))
            light += seen[..., np.newaxis] * (dark + bright[..., np.newaxis] * (lit - dark))
        depth += own
    opacity = -np.expm1(-depth)[..., np.newaxis]
    if spec.show == "opacity":
        return Image(opacity.astype(np.float32), "data")
    return Image(np.concatenate([light, opacity], axis=-1).astype(np.float32), spec.meaning)


def _above(density: Numbers, reach: float) -> Numbers:
    """Return the integral of (height, width) upwards from each pixel's middle, in tiles."""
    height = len(density)
    rows = min(round(reach * height), height)
    if rows == 0:
        return np.zeros_like(density)
    # From the top of a copy of the tile above down to the bottom of the tile itself
    sums = np.cumsum(np.concatenate([np.zeros_like(density[:1]), density, density]), axis=0)
    first = np.arange(height) + height
    above: Numbers = sums[first] - sums[first - rows] + density / 2
    return above / height
