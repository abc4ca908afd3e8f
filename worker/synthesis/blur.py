"""A Gaussian over the joined edges of the tile, by Fourier transform: exact for any radius."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from worker.images.image import Image
from worker.synthesis._pointwise import held, wide

if TYPE_CHECKING:
    from collections.abc import Mapping

    from numpy.typing import NDArray

    from api_schemas.textures.blur import BlurSpec
    from worker.stages import Report


def synthesize(
    spec: BlurSpec, size: tuple[int, int], inputs: Mapping[str, Image], report: Report
) -> Image:
    """Smooth every channel of `inputs["input"]`, premultiplied alpha with it.

    Nothing becomes darker or brighter than the darkest and brightest texel of its channel.
    """
    image = inputs["input"]
    if not any(spec.radius):
        return image
    pixels = np.empty(image.pixels.shape, np.float32)
    for channel in range(image.channels):
        values = wide(image.pixels[..., channel])
        pixels[..., channel] = held(smooth(values, (spec.radius[0], spec.radius[1])))
    return Image(pixels, image.meaning)


def smooth(values: NDArray[np.float64], radius: tuple[float, float]) -> NDArray[np.float64]:
    """Return (height, width) numbers smoothed by deviations along u and v in tiles."""
    height, width = values.shape
    across = _fade(np.fft.rfftfreq(width, 1 / width), radius[0])
    down = _fade(np.fft.fftfreq(height, 1 / height), radius[1])
    waves = np.fft.rfft2(values)
    waves *= down[:, np.newaxis] * across
    smoothed = np.fft.irfft2(waves, values.shape)
    return np.clip(smoothed, values.min(), values.max())


def _fade(swings: NDArray[np.floating[Any]], radius: float) -> NDArray[np.float64]:
    """Return what a Gaussian leaves of waves by their swings per tile."""
    faded: NDArray[np.float64] = np.exp(-2 * (np.pi * radius * swings) ** 2)
    return faded
