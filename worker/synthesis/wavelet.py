"""Wavelet noise in two dimensions (Cook and DeRose, 2005).

Band b has 2^(b + 1) frequency coefficients per tile along u and v, made anew for each band and
blended by quadratic B-splines; most of its energy lies between 2^(b - 1) and 2^b frequency swings
per tile, and practically none below half of that. With weights gain^b the sum n is divided by the
root of the sum of their squares times the variance of one band, so its variance is 1. A band fades
like an octave of Perlin noise, from full strength at four pixels per finest swing to nothing at
two; its share of the variance is not given to others.

`range: signed` gives n/4, `range: unit` gives (n/4 + 1)/2.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from api_schemas.textures.wavelet import WaveletSpec
from worker.images.image import Image
from worker.numba_kernel import parallel_kernel, prange
from worker.stages import silent
from worker.synthesis._perlin_octaves import visibility
from worker.synthesis._wavelet_bands import band

if TYPE_CHECKING:
    from collections.abc import Mapping

    from numpy.typing import NDArray

    from worker.stages import Report

VARIANCES = {"paper": 0.265, "exact": 0.269936}
"""Of one band with weight 1: as printed, and as the filters give on average."""


class Blends(NamedTuple):
    """Which three coefficients of an axis make each pixel: middles[i] - 1 + t by weights[i, t]."""

    middles: NDArray[np.int64]
    weights: NDArray[np.float32]


def synthesize(
    spec: WaveletSpec, size: tuple[int, int], inputs: Mapping[str, Image], report: Report
) -> Image:
    """Evaluate the noise at the pixel centres of (width, height): one channel of data."""
    width, height = size
    scale, bias = (0.125, 0.5) if spec.range == "unit" else (0.25, 0.0)
    gains = [spec.gain**b for b in range(spec.bands)]
    whole = np.sqrt(VARIANCES[spec.normalization] * sum(gain * gain for gain in gains))
    pixels = np.full((height, width), bias, np.float32)
    for b, gain in enumerate(gains):
        swings = spec.frequency * 2**b
        weight = gain * visibility(min(size) / swings) * scale / whole
        if weight > 0:
            _add_band(
                pixels,
                band(spec.seed, b, 2 * swings) * np.float32(weight),
                spline_blends(np.arange(height)[::-1], height, 2 * swings),
                spline_blends(np.arange(width), width, 2 * swings),
            )
    return Image(pixels[..., np.newaxis], spec.meaning)


def spline_blends(index: NDArray[np.int64], pixels: int, coefficients: int) -> Blends:
    """Return the quadratic B-splines at pixel centres; places are whole numbers of half pixels."""
    place = (2 * index + 1) * coefficients - pixels
    middles = -(-place // (2 * pixels))
    t = (middles * 2 * pixels - place) / (2 * pixels)
    first, last = t * t / 2, (1 - t) * (1 - t) / 2
    weights = np.stack([first, 1 - first - last, last], axis=-1)
    return Blends(middles % coefficients, weights.astype(np.float32))


def warm() -> None:
    """Compile the kernels."""
    synthesize(WaveletSpec(technique="wavelet", frequency=1), (8, 8), {}, silent)


@parallel_kernel
def _add_band(
    pixels: NDArray[np.float32],
    coefficients: NDArray[np.float32],
    rows: Blends,
    columns: Blends,
) -> None:
    side = len(coefficients)
    height, width = pixels.shape
    for row in prange(height):
        middle = rows.middles[row]
        low, high = coefficients[middle - 1], coefficients[(middle + 1) % side]
        share, weights = rows.weights[row], columns.weights
        line = share[0] * low + share[1] * coefficients[middle] + share[2] * high
        for column in range(width):
            i = columns.middles[column]
            pixels[row, column] += (
                weights[column, 0] * line[i - 1]
                + weights[column, 1] * line[i]
                + weights[column, 2] * line[(i + 1) % side]
            )
