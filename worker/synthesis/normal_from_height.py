"""Normals of a relief (Blinn, 1978), by central differences across the joined edges.

In the frame of the tile: x along u, y along v, which is up in the picture, z out of the surface.
`range: unit` packs a component n as (n + 1)/2.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from api_schemas.base import FLOAT32_MAX
from worker.images.image import Image
from worker.numba_kernel import kernel, parallel_kernel, prange

if TYPE_CHECKING:
    from collections.abc import Mapping

    from numpy.typing import NDArray

    from api_schemas.textures.normal_from_height import NormalFromHeightSpec
    from worker.stages import Report


def synthesize(
    spec: NormalFromHeightSpec, size: tuple[int, int], inputs: Mapping[str, Image], report: Report
) -> Image:
    """Return the unit normals of the first channel of `inputs["height"]`: three channels."""
    heights = np.array(inputs["height"].pixels[..., 0])
    normals = np.empty((*heights.shape, 3), np.float32)
    scale, bias = (0.5, 0.5) if spec.range == "unit" else (1.0, 0.0)
    _fill_normals(normals, heights, spec.depth, scale, bias)
    return Image(normals, spec.meaning)


def warm() -> None:
    """Compile the kernels."""
    _fill_normals(np.empty((1, 1, 3), np.float32), np.zeros((1, 1), np.float32), 1.0, 1.0, 0.0)


@parallel_kernel
def _fill_normals(
    normals: NDArray[np.float32],
    heights: NDArray[np.float32],
    depth: float,
    scale: float,
    bias: float,
) -> None:
    height, width = heights.shape
    for row in prange(height):
        above, below = heights[(row - 1) % height], heights[(row + 1) % height]
        for column in range(width):
            left, right = heights[row, column - 1], heights[row, (column + 1) % width]
            x = _slope(left, right) * -depth * width
            y = _slope(below[column], above[column]) * -depth * height
            length = np.sqrt(x * x + y * y + 1)
            normals[row, column, 0] = x / length * scale + bias
            normals[row, column, 1] = y / length * scale + bias
            normals[row, column, 2] = 1 / length * scale + bias


@kernel
def _slope(low: float, high: float) -> float:
    """Return half the difference, of numbers held within what float32 has."""
    first = min(max(np.float64(low), -FLOAT32_MAX), FLOAT32_MAX)
    last = min(max(np.float64(high), -FLOAT32_MAX), FLOAT32_MAX)
    return (last - first) / 2
