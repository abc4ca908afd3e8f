"""A texture looked up at places that another one displaces (Perlin, 1985), blended bilinearly."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from worker.images.image import Image
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


def warm() -> None:
    """Compile the kernel."""
    texel = np.zeros((1, 1, 1), np.float32)
    _fill_warped(np.empty_like(texel), texel, texel[..., 0], texel[..., 0], np.zeros(2), 0.0)


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
                upper = (1 - x) * texels[r, c, channel] + x * texels[r, right, channel]
                lower = (1 - x) * texels[below, c, channel] + x * texels[below, right, channel]
                pixels[row, column, channel] = (1 - y) * upper + y * lower


@kernel
def _wrapped(index: int, shift: float, length: int) -> int:
    """Return index + shift modulo length, for a whole shift that may exceed every integer."""
    # Beyond 2^53 the difference is rounded, but stays an index
    within = shift - length * np.floor(shift / length)
    moved = index + int(min(max(within, 0.0), length - 1.0))
    return moved if moved < length else moved - length
