"""Gradient noise along a line (Perlin, 1985; Hughes et al., 2013): a curve, values, numbers.

A pixel is as dark as its distance to the curve says, to which 32 chords round it are taken.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from worker.images.image import Image
from worker.numba_kernel import parallel_kernel, prange
from worker.outcome import Outcome
from worker.synthesis._counter_hash import hashes
from worker.synthesis._perlin_points import FADES

if TYPE_CHECKING:
    from collections.abc import Mapping

    from numpy.typing import NDArray

    from api_schemas.textures.perlin_curve import PerlinCurveSpec
    from worker.stages import Report

    Numbers = NDArray[np.float64]

_CHORDS = 32


def synthesize(
    spec: PerlinCurveSpec, size: tuple[int, int], inputs: Mapping[str, Image], report: Report
) -> Outcome:
    """Draw one period, and tell `values` and `slopes` at the places asked for."""
    width, height = size
    period = len(gradients_of(spec))
    columns = np.arange(width) + 0.5
    if spec.show == "values":
        values, _ = noise_at(spec, columns / width * period)
        pixels = np.tile((values + 1) / 2, (height, 1)).astype(np.float32)
    else:
        half = spec.thickness * height / 2
        ways = np.linspace(-half - 1, half + 1, _CHORDS + 1)
        values, _ = noise_at(spec, np.add.outer(columns, ways).ravel() / width * period)
        pixels = np.empty((height, width), np.float32)
        # In pixels, downwards from the top
        heights = ((1 - values) / 2 * height).reshape(width, _CHORDS + 1)
        _fill_curve(pixels, heights, ways, half)
    told, slopes = noise_at(spec, np.array(spec.at, np.float64))
    return Outcome(
        Image(pixels[..., np.newaxis], spec.meaning),
        report={"values": told.tolist(), "slopes": slopes.tolist()} if spec.at else {},
    )


def gradients_of(spec: PerlinCurveSpec) -> Numbers:
    """Return the slopes at 0, 1, .. up to the period."""
    if spec.gradients:
        return np.array(spec.gradients, np.float64)
    return (hashes(spec.seed, 0, spec.frequency) % np.uint64(3)).astype(np.float64) - 1


def noise_at(spec: PerlinCurveSpec, x: Numbers) -> tuple[Numbers, Numbers]:
    """Return values and slopes at places counted in steps from slope to slope."""
    gradients = gradients_of(spec)
    cells = np.floor(x)
    s = x - cells
    left = gradients[cells.astype(np.int64) % len(gradients)]
    right = gradients[(cells.astype(np.int64) + 1) % len(gradients)]
    powers = np.arange(1, 6)
    terms = s[:, np.newaxis] ** powers
    blend = terms @ FADES[spec.fade]
    growth = (s[:, np.newaxis] ** (powers - 1)) @ (powers * FADES[spec.fade])
    ahead, behind = left * s, right * (s - 1)
    values = ahead + blend * (behind - ahead)
    slopes = left + blend * (right - left) + growth * (behind - ahead)
    return values, slopes


def warm() -> None:
    """Compile the kernel."""
    _fill_curve(np.empty((1, 1), np.float32), np.zeros((1, 2)), np.arange(2.0), 1.0)


@parallel_kernel
def _fill_curve(pixels: NDArray[np.float32], heights: Numbers, ways: Numbers, half: float) -> None:
    """Write 1 less the ink; seen from a column the curve runs through (ways, heights[column])."""
    for row in prange(len(pixels)):
        for column in range(pixels.shape[1]):
            nearest = np.inf
            for chord in range(len(ways) - 1):
                x, y = ways[chord], heights[column, chord] - (row + 0.5)
                along, down = ways[chord + 1] - x, heights[column, chord + 1] - (row + 0.5) - y
                t = -(x * along + y * down) / (along * along + down * down)
                t = min(max(t, 0.0), 1.0)
                across, off = x + t * along, y + t * down
                nearest = min(nearest, across * across + off * off)
            pixels[row, column] = 1 - min(max(half + 0.5 - np.sqrt(nearest), 0.0), 1.0)
