"""A texture looked up elsewhere: moved, turned, mirrored, repeated.

Where the texture shrinks, a pixel is the mean of as many samples along each side as tiles fit in
one, so that whole numbers of repeats keep the mean exactly.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from worker.images.image import Image
from worker.numba_kernel import kernel, parallel_kernel, prange

if TYPE_CHECKING:
    from collections.abc import Mapping

    from numpy.typing import NDArray

    from api_schemas.textures.transform import TransformSpec
    from worker.stages import Report


def synthesize(
    spec: TransformSpec, size: tuple[int, int], inputs: Mapping[str, Image], report: Report
) -> Image:
    """Look `inputs["input"]` up where the transform leads, bilinear and wrapped."""
    image = inputs["input"]
    cosine, sine = np.cos(spec.rotation), np.sin(spec.rotation)
    across, up = spec.scale
    to_tile = np.array([[cosine * across, -sine * up], [sine * across, cosine * up]])
    # In tiles whole shifts change nothing, and what remains is exact for shifts by whole texels
    offset = np.array(spec.offset) - np.floor(spec.offset)
    pixels = np.empty(image.pixels.shape, np.float32)
    _fill_transformed(pixels, np.array(image.pixels), to_tile, offset, spec.samples())
    return Image(pixels, image.meaning)


def warm() -> None:
    """Compile the kernels."""
    texel = np.zeros((1, 1, 1), np.float32)
    _fill_transformed(np.empty_like(texel), texel, np.eye(2), np.zeros(2), (1, 1))


@parallel_kernel
def _fill_transformed(
    pixels: NDArray[np.float32],
    texels: NDArray[np.float32],
    to_tile: NDArray[np.float64],
    offset: NDArray[np.float64],
    samples: tuple[int, int],
) -> None:
    height, width, channels = texels.shape
    count = samples[0] * samples[1]
    for row in prange(height):
        totals = np.zeros(channels)
        for column in range(width):
            totals[:] = 0.0
            for sample in range(count):
                u = (column + (sample % samples[0] + 0.5) / samples[0]) / width
                v = 1.0 - (row + (sample // samples[0] + 0.5) / samples[1]) / height
                x = to_tile[0, 0] * u + to_tile[0, 1] * v + offset[0]
                y = to_tile[1, 0] * u + to_tile[1, 1] * v + offset[1]
                _add_texel(totals, texels, x * width - 0.5, (1.0 - y) * height - 0.5)
            for channel in range(channels):
                pixels[row, column, channel] = totals[channel] / count


@kernel
def _add_texel(
    totals: NDArray[np.float64], texels: NDArray[np.float32], x: float, y: float
) -> None:
    """Add the bilinear value at texel coordinates, counted from the middle of the first texel."""
    height, width, channels = texels.shape
    # Texels that are met but for rounding are met: shares below a millionth count as none
    x, y = np.round(x * 2.0**20) / 2.0**20, np.round(y * 2.0**20) / 2.0**20
    left, top = int(np.floor(x)), int(np.floor(y))
    share, depth = x - left, y - top
    first, above = left % width, top % height
    second, below = (first + 1) % width, (above + 1) % height
    for channel in range(channels):
        upper, lower = np.float64(texels[above, first, channel]), 0.0
        if share > 0:
            upper = (1 - share) * upper + share * texels[above, second, channel]
        if depth > 0:
            lower = np.float64(texels[below, first, channel])
            if share > 0:
                lower = (1 - share) * lower + share * texels[below, second, channel]
        totals[channel] += (1 - depth) * upper + depth * lower
