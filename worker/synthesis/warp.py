"""A texture looked up at places that another one displaces (Perlin, 1985), blended linearly."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from worker.images.image import Image
from worker.images.volume import Volume
from worker.numba_kernel import kernel, parallel_kernel, prange

if TYPE_CHECKING:
    from collections.abc import Mapping

    from numpy.typing import NDArray

    from api_schemas.textures.warp import WarpSpec
    from worker.stages import Report


def synthesize(
    spec: WarpSpec, size: tuple[int, int], inputs: Mapping[str, Image], report: Report
) -> Image:
    """Look `inputs["input"]` up, wrapped, where `inputs["by"]` points to."""
    pixels = np.empty(inputs["input"].pixels.shape, np.float32)
    by = inputs["by"].pixels
    _fill_warped(
        pixels,
        np.array(inputs["input"].pixels),
        np.array(by[..., 0]),
        np.array(by[..., min(1, by.shape[2] - 1)]),
        np.array(spec.strength),
        spec.rest,
    )
    return Image(pixels, inputs["input"].meaning)


def synthesize_volume(
    spec: WarpSpec, size: tuple[int, int, int], inputs: Mapping[str, Volume], report: Report
) -> Volume:
    """Look `inputs["input"]` up, wrapped, where `inputs["by"]` points to in space."""
    voxels = np.empty(inputs["input"].voxels.shape, np.float32)
    by = inputs["by"].voxels
    channels = [min(axis, by.shape[3] - 1) for axis in range(3)]
    _fill_warped_volume(
        voxels,
        np.array(inputs["input"].voxels),
        np.array(by[..., channels]),
        np.array([*spec.strength, spec.strength[-1]][:3]),
        spec.rest,
    )
    return Volume(voxels, inputs["input"].meaning)


def warm() -> None:
    """Compile the kernels."""
    texel = np.zeros((1, 1, 1), np.float32)
    _fill_warped(np.empty_like(texel), texel, texel[..., 0], texel[..., 0], np.zeros(2), 0.0)
    voxel, by = np.zeros((1, 1, 1, 1), np.float32), np.zeros((1, 1, 1, 3), np.float32)
    _fill_warped_volume(np.empty_like(voxel), voxel, by, np.zeros(3), 0.0)


@parallel_kernel
def _fill_warped(
    pixels: NDArray[np.float32],
    texels: NDArray[np.float32],
    by_u: NDArray[np.float32],
    by_v: NDArray[np.float32],
    strength: NDArray[np.float64],
    rest: float,
) -> None:
    height, width, channels = texels.shape
    for row in prange(height):
        for column in range(width):
            across = strength[0] * (np.float64(by_u[row, column]) - rest) * width
            up = strength[1] * (np.float64(by_v[row, column]) - rest) * height
            left, top = np.floor(across), np.floor(-up)
            x, y = across - left, -up - top
            c = _wrapped(column, left, width)
            r = _wrapped(row, top, height)
            right, below = (c + 1 if c + 1 < width else 0), (r + 1 if r + 1 < height else 0)
            for channel in range(channels):
                pixels[row, column, channel] = _blend(texels, r, below, c, right, channel, x, y)


@parallel_kernel
def _fill_warped_volume(
    voxels: NDArray[np.float32],
    texels: NDArray[np.float32],
    by: NDArray[np.float32],
    strength: NDArray[np.float64],
    rest: float,
) -> None:
    depth, height, width, channels = texels.shape
    for s in prange(depth):
        for r in range(height):
            for c in range(width):
                across = strength[0] * (np.float64(by[s, r, c, 0]) - rest) * width
                up = strength[1] * (np.float64(by[s, r, c, 1]) - rest) * height
                deep = strength[2] * (np.float64(by[s, r, c, 2]) - rest) * depth
                left, top, front = np.floor(across), np.floor(-up), np.floor(deep)
                x, y, z = across - left, -up - top, deep - front
                column = _wrapped(c, left, width)
                row = _wrapped(r, top, height)
                first = _wrapped(s, front, depth)
                right, below = (column + 1) % width, (row + 1) % height
                behind = (first + 1) % depth
                for channel in range(channels):
                    near = _blend(texels[first], row, below, column, right, channel, x, y)
                    far = _blend(texels[behind], row, below, column, right, channel, x, y)
                    voxels[s, r, c, channel] = (1 - z) * near + z * far


@kernel
def _blend(
    texels: NDArray[np.float32],
    row: int,
    below: int,
    column: int,
    right: int,
    channel: int,
    x: float,
    y: float,
) -> float:
    upper = (1 - x) * texels[row, column, channel] + x * texels[row, right, channel]
    lower = (1 - x) * texels[below, column, channel] + x * texels[below, right, channel]
    blend: float = (1 - y) * upper + y * lower
    return blend


@kernel
def _wrapped(index: int, shift: float, length: int) -> int:
    """Return index + shift modulo length, for a whole shift that may exceed every integer."""
    # Beyond 2^53 the difference is rounded, but stays an index
    within = shift - length * np.floor(shift / length)
    moved = index + int(min(max(within, 0.0), length - 1.0))
    return moved if moved < length else moved - length
