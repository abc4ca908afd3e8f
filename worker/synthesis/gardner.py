"""A sum of cosines, the poor man's Fourier series (Gardner, 1985).

With whole numbers of swings per tile the sum repeats without a seam. Since cos(p + q) =
cos p cos q - sin p sin q, a picture of n waves is one product of a (height, 2n) and a (2n, width)
matrix, and so is each slice of a solid. Each pixel holds the mean over its area: the mean of a
cosine over a pixel is its value at the centre times a sinc along each side, so waves too fine for
the pixels fade.

The waves of a seed are drawn from all whole (a, b) with frequency <= |(a, b)| <= frequency +
bandwidth, one of each pair (a, b), (-a, -b), which are the same wave; none twice unless the count
exceeds what there is. Those of a solid are drawn from all whole (a, b, c).
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from worker.images.image import Image
from worker.images.volume import Volume
from worker.synthesis._counter_hash import hashes, uniforms

if TYPE_CHECKING:
    from collections.abc import Mapping

    from numpy.typing import NDArray

    from api_schemas.textures.gardner import GardnerSpec
    from worker.closed_form import Parameter
    from worker.stages import Report


def synthesize(
    spec: GardnerSpec, size: tuple[int, int], inputs: Mapping[str, Image], report: Report
) -> Image:
    """Average the tile over each pixel of (width, height): one channel of data."""
    return Image(_slices(spec, (*size, 1), 2, report)[0], spec.meaning)


def synthesize_volume(
    spec: GardnerSpec, size: tuple[int, int, int], inputs: Mapping[str, Volume], report: Report
) -> Volume:
    """Average the solid tile over each voxel of (width, height, depth): one channel of data."""
    return Volume(_slices(spec, size, 3, report), spec.meaning)


def mean_at(
    spec: GardnerSpec, places: NDArray[np.float64], sides: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Return means (n,) over parallelograms or boxes around points.

    Args:
        spec: The waves.
        places: Of the plane (n, 2) or of space (n, 3), in tiles.
        sides: Of every box, (sides, 2) or (sides, 3), in tiles.
    """
    axes = places.shape[1]
    cycles, phases = waves_of(spec, axes)
    fades = np.sinc(cycles[:, :axes] @ sides.T).prod(axis=1)
    scale, bias = _scale_and_bias(spec)
    angles = 2 * np.pi * (places @ cycles[:, :axes].T) + phases
    means: NDArray[np.float64] = np.cos(angles) @ fades * (scale / len(cycles)) + bias
    return means


def closed_form(spec: GardnerSpec, *, solid: bool) -> Mapping[str, Parameter]:
    """Return the waves, phases in turns, and what becomes of their sum."""
    cycles, phases = waves_of(spec, 3 if solid else 2)
    turns = (phases / (2 * np.pi) % 1)[:, np.newaxis]
    scale, bias = _scale_and_bias(spec)
    return {
        "waves": np.concatenate([cycles, turns], axis=1).astype(np.float32),
        "count": len(cycles),
        "scale": scale / len(cycles),
        "bias": bias,
    }


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


def waves_of(spec: GardnerSpec, axes: int) -> tuple[NDArray[np.int64], NDArray[np.float64]]:
    """Return the swings per tile, shape (n, 3), and the phases in radians, shape (n,).

    Of a plane, with two axes, the third swings are 0 unless waves are given that have them.
    """
    if spec.waves:
        cycles = np.array([(*wave.cycles, 0)[:3] for wave in spec.waves], np.int64)
        return cycles, np.array([wave.phase for wave in spec.waves])
    band = _half_annulus(spec.frequency, spec.frequency + spec.bandwidth, axes)
    order = np.argsort(hashes(spec.seed, 0, len(band)), kind="stable")
    chosen = order[np.arange(spec.count) % len(band)]
    return band[chosen], 2 * np.pi * uniforms(spec.seed, 1, spec.count)


def _slices(
    spec: GardnerSpec, size: tuple[int, int, int], axes: int, report: Report
) -> NDArray[np.float32]:
    """Return (depth, height, width, 1); a picture is the only slice, and at w = 0."""
    width, height, depth = size
    cycles, phases = waves_of(spec, axes)
    scale, bias = _scale_and_bias(spec)
    columns, fades = _angles(cycles[:, 0], np.arange(width), width)
    rows, fades_v = _angles(cycles[:, 1], np.arange(height)[::-1], height)
    rows += phases[:, np.newaxis]
    turns, fades_w = _angles(cycles[:, 2], np.arange(depth), depth)
    if axes == 2:
        turns, fades_w = np.zeros((len(cycles), 1)), np.ones(len(cycles))
    weights = (scale / len(cycles) * fades * fades_v * fades_w)[:, np.newaxis]
    across = np.concatenate([np.cos(columns), np.sin(columns), np.ones((1, width))])
    across = across.astype(np.float32)
    voxels = np.empty((depth, height, width), np.float32)
    for index in range(depth):
        report(index / depth, "slices")
        angles = rows + turns[:, index : index + 1]
        down = [weights * np.cos(angles), -weights * np.sin(angles), np.full((1, height), bias)]
        np.matmul(np.concatenate(down).T.astype(np.float32), across, out=voxels[index])
    return voxels[..., np.newaxis]


def _scale_and_bias(spec: GardnerSpec) -> tuple[float, float]:
    return (0.5, 0.5) if spec.range == "unit" else (1.0, 0.0)


def _half_annulus(inner: int, outer: int, axes: int) -> NDArray[np.int64]:
    sides = [np.arange(outer + 1), *[np.arange(-outer, outer + 1)] * (axes - 1)]
    grid = np.meshgrid(*sides, indexing="ij")
    square = sum(side * side for side in grid)
    ahead = grid[-1] > 0
    for side in grid[-2::-1]:
        ahead = (side > 0) | ((side == 0) & ahead)
    inside = (square >= inner * inner) & (square <= outer * outer) & ahead
    found = np.zeros((np.count_nonzero(inside), 3), np.int64)
    found[:, :axes] = np.stack([side[inside] for side in grid], axis=-1)
    return found


def _angles(
    cycles: NDArray[np.int64], index: NDArray[np.int64], pixels: int
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return the angles at pixel centres, shape (n, len(index)), and what averaging leaves, (n,).

    Counted in integers, in units of half a pixel's turn, so that angles repeat bit for bit.
    """
    turns = np.multiply.outer(cycles, 2 * index + 1) % (2 * pixels)
    return turns * (np.pi / pixels), np.sinc(cycles / pixels)
