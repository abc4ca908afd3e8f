"""A blend of two textures (Porter and Duff, 1984), by a number or by the value of a third."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from api_schemas.families import TextureSpec
from worker.images.image import Image
from worker.numba_kernel import parallel_kernel, prange
from worker.synthesis._channels import joint_meaning, matched

if TYPE_CHECKING:
    from collections.abc import Mapping

    from numpy.typing import NDArray

    from api_schemas.textures.mix import MixSpec
    from worker.closed_form import Parameter
    from worker.stages import Report


def synthesize(
    spec: MixSpec, size: tuple[int, int], inputs: Mapping[str, Image], report: Report
) -> Image:
    """Blend `inputs["a"]` and `inputs["b"]`; colours with alpha are blended premultiplied."""
    a, b = matched(inputs["a"], inputs["b"])
    if "amount" in inputs:
        shares = inputs["amount"].pixels[..., 0]
    else:
        shares = np.full(a.shape[:2], spec.amount, np.float32)
    pixels = np.empty(a.shape, np.float32)
    _fill_mix(pixels, np.array(a), np.array(b), np.array(shares))
    return Image(pixels, joint_meaning(inputs["a"], inputs["b"]))


def closed_form(spec: MixSpec, *, solid: bool) -> Mapping[str, Parameter]:
    """Return the amount, where it is a number."""
    if isinstance(spec.amount, TextureSpec):
        return {}
    return {"amount_value": np.full(4, spec.amount, np.float32)}


def warm() -> None:
    """Compile the kernel."""
    texel = np.zeros((1, 1, 1), np.float32)
    _fill_mix(np.empty_like(texel), texel, texel, texel[..., 0])


@parallel_kernel
def _fill_mix(
    pixels: NDArray[np.float32],
    a: NDArray[np.float32],
    b: NDArray[np.float32],
    shares: NDArray[np.float32],
) -> None:
    height, width, channels = pixels.shape
    for row in prange(height):
        for column in range(width):
            # In float64, so that equal inputs come out as they are
            share = min(max(np.float64(shares[row, column]), 0.0), 1.0)
            for channel in range(channels):
                first = np.float64(a[row, column, channel])
                second = np.float64(b[row, column, channel])
                pixels[row, column, channel] = (1.0 - share) * first + share * second
