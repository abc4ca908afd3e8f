"""Sparse convolution with Gabor kernels (Lagae et al., 2009).

A kernel is a wave under a Gaussian, and cos(p + q) = cos p cos q - sin p sin q: over rows and
columns it is the sum of two products, so adding one takes two multiplications a pixel. Kernels are
cut where the Gaussian falls below 1/1000. Those beyond an edge come back at the opposite one.

A Poisson process of points is made by their number first, rounded so that the variance is exactly
the one stated on average, and their places next; weights are +1 or -1. Where the waves are finer
than the pixels show, they fade as an octave of Perlin noise does.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from api_schemas.textures.gabor import GaborSpec
from worker.images.image import Image
from worker.images.volume import Volume
from worker.numba_kernel import parallel_kernel, prange
from worker.stages import silent
from worker.synthesis._counter_hash import uniforms
from worker.synthesis._gabor_rows import CUT, add, tabulate
from worker.synthesis._gabor_solid import fill_solid_kernels, solid_energy, solid_impulses
from worker.synthesis._perlin_octaves import visibility

if TYPE_CHECKING:
    from collections.abc import Mapping

    from numpy.typing import NDArray

    from worker.stages import Report

    Numbers = NDArray[np.float64]

_BAND_ROWS = 32


class Impulses(NamedTuple):
    """Where kernels are, (n,) each: places in tiles, the waves' directions, and the weights."""

    u: Numbers
    v: Numbers
    directions: Numbers
    weights: Numbers


def synthesize(
    spec: GaborSpec, size: tuple[int, int], inputs: Mapping[str, Image], report: Report
) -> Image:
    """Add kernels at the pixel centres of (width, height): one channel of data."""
    width, height = size
    found = impulses_of(spec)
    scale, bias = (0.125, 0.5) if spec.range == "unit" else (0.25, 0.0)
    visible = visibility(min(size) / (spec.frequency + spec.bandwidth))
    values = np.zeros((height, width))
    if visible > 0:
        weights = found.weights * (visible * scale / np.sqrt(variance(spec, len(found.u))))
        _fill_kernels(values, found._replace(weights=weights), spec.frequency, spec.bandwidth)
    return Image((values + bias).astype(np.float32)[..., np.newaxis], spec.meaning)


def synthesize_volume(
    spec: GaborSpec, size: tuple[int, int, int], inputs: Mapping[str, Volume], report: Report
) -> Volume:
    """Add kernels of space at the voxel centres of (width, height, depth)."""
    width, height, depth = size
    found = solid_impulses(spec)
    scale, bias = (0.125, 0.5) if spec.range == "unit" else (0.25, 0.0)
    visible = visibility(min(size) / (spec.frequency + spec.bandwidth))
    values = np.zeros((depth, height, width))
    if visible > 0:
        variance = len(found.weights) * solid_energy(spec.frequency, spec.bandwidth)
        weights = found.weights * (visible * scale / np.sqrt(variance))
        kernels = found._replace(weights=weights)
        fill_solid_kernels(values, kernels, spec.frequency, spec.bandwidth)
    return Volume((values + bias).astype(np.float32)[..., np.newaxis], spec.meaning)


def impulses_of(spec: GaborSpec) -> Impulses:
    """Strew the kernels of a tile."""
    count = max(1, round(spec.impulses * spec.bandwidth**2 / (np.pi * CUT * CUT)))
    u, v, turn, sign = (uniforms(spec.seed, use, count) for use in range(4))
    return Impulses(
        u, v, spec.orientation + spec.spread * (2 * turn - 1), np.where(sign < 0.5, -1.0, 1.0)
    )


def variance(spec: GaborSpec, density: float) -> float:
    """Return the variance of so many kernels per tile: density times the integral of g^2."""
    return density * energy(spec.frequency, spec.bandwidth)


def energy(frequency: float, bandwidth: float) -> float:
    """Return the integral of the squared kernel over the plane, in the units of 1 / bandwidth^2."""
    return float(
        (1 + np.exp(-2 * np.pi * (frequency / bandwidth) ** 2)) / (4 * bandwidth * bandwidth)
    )


def warm() -> None:
    """Compile the kernels."""
    spec = GaborSpec(technique="gabor", frequency=1, bandwidth=1, impulses=1)
    synthesize(spec, (16, 16), {}, silent)
    synthesize_volume(spec, (8, 8, 8), {}, silent)


@parallel_kernel
def _fill_kernels(values: Numbers, impulses: Impulses, frequency: float, bandwidth: float) -> None:
    """Add all kernels to (height, width); each band of rows takes them in the same order."""
    height, width = values.shape
    reach = CUT / bandwidth
    for band in prange((height + _BAND_ROWS - 1) // _BAND_ROWS):
        top = band * _BAND_ROWS
        bottom = min(top + _BAND_ROWS, height)
        columns = int(2 * reach * width) + 2
        cosines, sines = np.empty(columns), np.empty(columns)
        for n in range(len(impulses.u)):
            first = int(np.ceil((impulses.u[n] - reach) * width - 0.5))
            last = int(np.floor((impulses.u[n] + reach) * width - 0.5))
            along = frequency * np.cos(impulses.directions[n])
            across = frequency * np.sin(impulses.directions[n])
            made = False
            for row in range(top, bottom):
                # Of the rows a tile apart, those that lie within reach
                v = 1 - (row + 0.5) / height - impulses.v[n]
                for turn in range(int(np.ceil(-reach - v)), int(np.floor(reach - v)) + 1):
                    if not made:
                        tabulate(
                            cosines, sines, first, last, impulses.u[n], width, along, bandwidth
                        )
                        made = True
                    y = v + turn
                    under = impulses.weights[n] * np.exp(-np.pi * (bandwidth * y) ** 2)
                    angle = 2 * np.pi * across * y
                    a, b = under * np.cos(angle), under * np.sin(angle)
                    add(values[row], first, last - first + 1, a, b, cosines, sines)
