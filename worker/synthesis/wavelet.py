"""Wavelet noise in pictures and solids (Cook and DeRose, 2005).

Band b has 2^(b + 1) frequency coefficients per tile along each side, made anew for each band and
blended by quadratic B-splines; most of its energy lies between 2^(b - 1) and 2^b frequency swings
per tile, and practically none below half of that. With weights gain^b the sum n is divided by the
root of the sum of their squares times the variance of one band, so its variance is 1. A band fades
like an octave of Perlin noise, from full strength at four pixels per finest swing to nothing at
two; its share of the variance is not given to others.

A plane through a solid is either cut, or what lies before and behind it is blended in: each
coefficient by the spline at the point half way between it and its foot on the plane.

`range: signed` gives n/4, `range: unit` gives (n/4 + 1)/2.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from api_schemas.textures.wavelet import WaveletSpec
from worker.images.image import Image
from worker.images.volume import Volume
from worker.numba_kernel import parallel_kernel, prange
from worker.stages import silent
from worker.synthesis._perlin_octaves import visibility
from worker.synthesis._wavelet_bands import band
from worker.synthesis._wavelet_points import fill_cut_at, fill_projected_at

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from numpy.typing import NDArray

    from worker.stages import Report

    Numbers = NDArray[np.float64]

VARIANCES = {
    "paper": {"plane": 0.265, "slice": 0.210, "projected": 0.296},
    "exact": {"plane": 0.269936, "slice": 0.195606, "projected": 0.305310},
}
"""Of one band with weight 1: as printed, and as the filters give on average.

The exact one of a projection is that along an axis; along a diagonal it is up to 7 % less.
"""


class Blends(NamedTuple):
    """Which three coefficients of an axis make each pixel: middles[i] - 1 + t by weights[i, t]."""

    middles: NDArray[np.int64]
    weights: NDArray[np.float32]


def synthesize(
    spec: WaveletSpec, size: tuple[int, int], inputs: Mapping[str, Image], report: Report
) -> Image:
    """Evaluate the noise at the pixel centres of (width, height): one channel of data."""
    width, height = size
    scale, bias = _scale_and_bias(spec)
    if spec.cut != "plane" and spec.tilt[0]:
        places, normal = _leaning_plane(spec, size)
        values = noise_at(spec, places, normal, min(size))
        return Image(values.reshape(height, width, 1).astype(np.float32), spec.meaning)
    pixels = np.full((height, width), bias, np.float32)
    for index, side, weight in _bands(spec, spec.cut, min(size)):
        if spec.cut == "plane":
            coefficients = band(spec.seed, index, side)
        else:
            report(index / spec.bands, "bands")
            coefficients = _flattened(spec, band(spec.seed, index, side, 3))
        _add_band(
            pixels,
            coefficients * np.float32(weight * scale),
            spline_blends(np.arange(height)[::-1], height, side),
            spline_blends(np.arange(width), width, side),
        )
    return Image(pixels[..., np.newaxis], spec.meaning)


def synthesize_volume(
    spec: WaveletSpec, size: tuple[int, int, int], inputs: Mapping[str, Volume], report: Report
) -> Volume:
    """Evaluate the solid noise at the voxel centres of (width, height, depth)."""
    width, height, depth = size
    scale, bias = _scale_and_bias(spec)
    voxels = np.full((depth, height, width), bias, np.float32)
    for index, side, weight in _bands(spec, "slice", min(size)):
        coefficients = band(spec.seed, index, side, 3) * np.float32(weight * scale)
        away = spline_blends(np.arange(depth), depth, side)
        rows = spline_blends(np.arange(height)[::-1], height, side)
        columns = spline_blends(np.arange(width), width, side)
        for s in range(depth):
            report((index + s / depth) / spec.bands, "slices")
            near = [coefficients[(away.middles[s] + t) % side] for t in (-1, 0, 1)]
            plane = sum(w * c for w, c in zip(away.weights[s], near, strict=True))
            _add_band(voxels[s], np.ascontiguousarray(plane), rows, columns)
    return Volume(voxels[..., np.newaxis], spec.meaning)


def noise_at(
    spec: WaveletSpec,
    places: Numbers,
    normals: Numbers,
    pixels_per_tile: float = np.inf,
) -> Numbers:
    """Evaluate the solid noise in float64 at points (n, 3) in tiles.

    A projection is onto the planes through these points with unit normals (n, 3), as on the surface
    of a mesh; other cuts do not look at them.
    """
    scale, bias = _scale_and_bias(spec)
    values = np.full(len(places), bias)
    kind = "projected" if spec.cut == "projected" else "slice"
    for index, side, weight in _bands(spec, kind, pixels_per_tile):
        coefficients = band(spec.seed, index, side, 3) * np.float32(weight * scale)
        if kind == "projected":
            fill_projected_at(values, places * side, normals, coefficients)
        else:
            fill_cut_at(values, places * side, coefficients)
    return values


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
    spec = WaveletSpec(technique="wavelet", frequency=1)
    synthesize(spec, (8, 8), {}, silent)
    for cut in ("slice", "projected"):
        leaning = spec.model_copy(update={"cut": cut, "tilt": [1.0, 0.0]})
        synthesize(leaning, (8, 8), {}, silent)


def _scale_and_bias(spec: WaveletSpec) -> tuple[float, float]:
    return (0.125, 0.5) if spec.range == "unit" else (0.25, 0.0)


def _bands(spec: WaveletSpec, cut: str, pixels_per_tile: float) -> Iterator[tuple[int, int, float]]:
    """Yield the number of each band that can be seen, its coefficients per side, its weight."""
    gains = [spec.gain**b for b in range(spec.bands)]
    variance = VARIANCES[spec.normalization][cut]
    whole = np.sqrt(variance * sum(gain * gain for gain in gains))
    for b, gain in enumerate(gains):
        swings = spec.frequency * 2**b
        weight = gain * visibility(pixels_per_tile / swings) / whole
        if weight > 0:
            yield b, 2 * swings, float(weight)


def _flattened(spec: WaveletSpec, coefficients: NDArray[np.float32]) -> NDArray[np.float32]:
    """Return the coefficients (side, side) of the plane at the depth asked, square to w."""
    side = len(coefficients)
    place = spec.depth % 1 * side
    # The splines of a projection are twice as wide along its normal
    width = 2 if spec.cut == "projected" else 1
    first = int(np.ceil(place - 1.5 * width))
    plane = np.zeros((side, side), np.float32)
    for c in range(first, int(np.floor(place + 1.5 * width)) + 1):
        plane += np.float32(spline((place - c) / width + 1.5)) * coefficients[c % side]
    return plane


def spline(t: float) -> float:
    """Return the quadratic B-spline over 0..3."""
    if not 0 < t < 3:
        return 0.0
    if t < 1:
        return t * t / 2
    return 1 - ((t - 1) ** 2 + (2 - t) ** 2) / 2 if t < 2 else (3 - t) ** 2 / 2


def _leaning_plane(spec: WaveletSpec, size: tuple[int, int]) -> tuple[Numbers, Numbers]:
    """Return places (n, 3) of pixel centres, and the plane's normal as often.

    The plane is turned about its middle (1/2, 1/2, depth) by the shortest way from square to w.
    """
    width, height = size
    lean, way = spec.tilt
    away = np.array([np.cos(way), np.sin(way), 0])
    side = np.array([-np.sin(way), np.cos(way), 0])
    w = np.array([0, 0, 1])
    turned = np.cos(lean) * away - np.sin(lean) * w
    normal = np.sin(lean) * away + np.cos(lean) * w
    u = np.cos(way) * turned - np.sin(way) * side
    v = np.sin(way) * turned + np.cos(way) * side
    across = (np.arange(width) + 0.5) / width - 0.5
    up = 0.5 - (np.arange(height) + 0.5) / height
    middle = np.array([0.5, 0.5, spec.depth])
    places = middle + across[:, np.newaxis] * u + up[:, np.newaxis, np.newaxis] * v
    flat = places.reshape(-1, 3)
    return flat, np.broadcast_to(normal, flat.shape).copy()


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
