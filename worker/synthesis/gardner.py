"""A sum of cosines, the poor man's Fourier series (Gardner, 1985).

With whole numbers of swings per tile the sum repeats without a seam. Since cos(p + q) =
cos p cos q - sin p sin q, a picture of n waves is one product of a (height, 2n) and a (2n, width)
matrix. Each pixel holds the mean over its area: the mean of a cosine over a pixel is its value at
the centre times a sinc along u and one along v, so waves too fine for the pixels fade.

The waves of a seed are drawn from all whole (a, b) with frequency <= |(a, b)| <= frequency +
bandwidth, one of each pair (a, b), (-a, -b), which are the same wave; none twice unless the count
exceeds what there is.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from worker.images.image import Image
from worker.synthesis._counter_hash import hashes, uniforms

if TYPE_CHECKING:
    from collections.abc import Mapping

    from numpy.typing import NDArray

    from api_schemas.textures.gardner import GardnerSpec
    from worker.stages import Report


def synthesize(
    spec: GardnerSpec, size: tuple[int, int], inputs: Mapping[str, Image], report: Report
) -> Image:
    """Average the tile over each pixel of (width, height): one channel of data."""
    width, height = size
    cycles, phases = waves_of(spec)
    scale, bias = (0.5, 0.5) if spec.range == "unit" else (1.0, 0.0)
    columns, fades_u = _angles(cycles[:, 0], np.arange(width), width)
    rows, fades_v = _angles(cycles[:, 1], np.arange(height)[::-1], height)
    rows += phases[:, np.newaxis]
    weights = (scale / len(cycles) * fades_u * fades_v)[:, np.newaxis]
    down = np.concatenate(
        [weights * np.cos(rows), -weights * np.sin(rows), np.full((1, height), bias)]
    )
    across = np.concatenate([np.cos(columns), np.sin(columns), np.ones((1, width))])
    pixels = np.empty((height, width), np.float32)
    np.matmul(down.T.astype(np.float32), across.astype(np.float32), out=pixels)
    return Image(pixels[..., np.newaxis], spec.meaning)


def sum_of_cosines(
    x: NDArray[np.float64],
    y: NDArray[np.float64],
    frequencies: NDArray[np.float64],
    phases: NDArray[np.float64],
) -> NDArray[np.float64]:
    """Return sum_i cos(a_i x + b_i y + c_i) at points, for any (n, 2) frequencies in radians."""
    angles = np.multiply.outer(x, frequencies[:, 0]) + np.multiply.outer(y, frequencies[:, 1])
    total: NDArray[np.float64] = np.cos(angles + phases).sum(axis=-1)
    return total


def waves_of(spec: GardnerSpec) -> tuple[NDArray[np.int64], NDArray[np.float64]]:
    """Return the swings per tile, shape (n, 2), and the phases in radians, shape (n,)."""
    if spec.waves:
        cycles = np.array([wave.cycles for wave in spec.waves], np.int64)
        return cycles, np.array([wave.phase for wave in spec.waves])
    band = _half_annulus(spec.frequency, spec.frequency + spec.bandwidth)
    order = np.argsort(hashes(spec.seed, 0, len(band)), kind="stable")
    chosen = order[np.arange(spec.count) % len(band)]
    return band[chosen], 2 * np.pi * uniforms(spec.seed, 1, spec.count)


def _half_annulus(inner: int, outer: int) -> NDArray[np.int64]:
    a, b = np.meshgrid(np.arange(outer + 1), np.arange(-outer, outer + 1), indexing="ij")
    square = a * a + b * b
    inside = (square >= inner * inner) & (square <= outer * outer) & ((a > 0) | (b > 0))
    return np.stack([a[inside], b[inside]], axis=-1)


def _angles(
    cycles: NDArray[np.int64], index: NDArray[np.int64], pixels: int
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return the angles at pixel centres, shape (n, len(index)), and what averaging leaves, (n,).

    Counted in integers, in units of half a pixel's turn, so that angles repeat bit for bit.
    """
    turns = np.multiply.outer(cycles, 2 * index + 1) % (2 * pixels)
    return turns * (np.pi / pixels), np.sinc(cycles / pixels)
