"""Values taken from one range to another along a power curve."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from api_schemas.base import FLOAT32_MAX
from worker.images.image import Image
from worker.numba_kernel import parallel_kernel, prange

if TYPE_CHECKING:
    from collections.abc import Mapping

    from numpy.typing import NDArray

    from api_schemas.textures.levels import LevelsSpec
    from worker.closed_form import Parameter
    from worker.stages import Report


def synthesize(
    spec: LevelsSpec, size: tuple[int, int], inputs: Mapping[str, Image], report: Report
) -> Image:
    """Change every channel of `inputs["input"]` but alpha, whose colour is changed straight.

    Below the range the curve goes on as that of the mirrored value. What float32 cannot hold
    becomes its largest number.
    """
    image = inputs["input"]
    after = np.empty(image.pixels.shape, np.float32)
    _fill_levels(
        after,
        np.array(image.pixels),
        image.has_alpha,
        np.array(spec.input_range),
        np.array(spec.output_range),
        1 / spec.gamma,
        spec.clamp,
    )
    return Image(after, image.meaning)


def closed_form(spec: LevelsSpec, *, solid: bool) -> Mapping[str, Parameter]:
    """Return the ranges and the curve."""
    return {
        "input_range": np.array(spec.input_range, np.float32),
        "output_range": np.array(spec.output_range, np.float32),
        "exponent": 1 / spec.gamma,
        "clamped": int(spec.clamp),
    }


def warm() -> None:
    """Compile the kernel."""
    texel = np.zeros((1, 1, 1), np.float32)
    _fill_levels(np.empty_like(texel), texel, False, np.zeros(2), np.zeros(2), 1.0, True)


@parallel_kernel
def _fill_levels(
    after: NDArray[np.float32],
    before: NDArray[np.float32],
    has_alpha: bool,
    input_range: NDArray[np.float64],
    output_range: NDArray[np.float64],
    exponent: float,
    clamp: bool,
) -> None:
    height, width, channels = before.shape
    start, length = input_range[0], input_range[1] - input_range[0]
    low, high = output_range[0], output_range[1]
    for row in prange(height):
        for column in range(width):
            alpha = np.float64(before[row, column, channels - 1]) if has_alpha else 1.0
            for channel in range(channels):
                value = np.float64(before[row, column, channel])
                if has_alpha and channel == channels - 1:
                    after[row, column, channel] = value
                    continue
                value = (value / alpha if alpha > 0 else 0.0) - start
                share = (0.0 if value < 0 else 1.0) if length == 0 else value / length
                share = min(max(share, -FLOAT32_MAX), FLOAT32_MAX)
                if clamp:
                    share = min(max(share, 0.0), 1.0)
                if exponent != 1:
                    share = math.copysign(abs(share) ** exponent, share)
                    share = min(max(share, -FLOAT32_MAX), FLOAT32_MAX)
                level = (low * (1 - share) + high * share) * alpha
                after[row, column, channel] = min(max(level, -FLOAT32_MAX), FLOAT32_MAX)
