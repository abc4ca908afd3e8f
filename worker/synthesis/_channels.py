"""Pictures with different channels brought together."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from api_schemas.families import Meaning
    from worker.images.image import Image


def joint_meaning(a: Image, b: Image) -> Meaning:
    """Return what a picture made of both is: data only if both are."""
    return "data" if a.meaning == b.meaning == "data" else "colour"


def matched(a: Image, b: Image) -> tuple[NDArray[np.float32], NDArray[np.float32]]:
    """Return the pixels of both pictures with equally many channels.

    A single channel is a grey and stands for as many as needed. Of colour, what has no alpha is
    opaque; channels that data lacks are 0.
    """
    if joint_meaning(a, b) == "data":
        count = max(a.channels, b.channels)
        return data_with(a.pixels, count), data_with(b.pixels, count)
    alpha = a.channels in (2, 4) or b.channels in (2, 4)
    hues = 3 if max(a.channels, b.channels) > 2 else 1
    return _colour_with(a.pixels, hues, alpha), _colour_with(b.pixels, hues, alpha)


def data_with(pixels: NDArray[np.float32], count: int) -> NDArray[np.float32]:
    """Return data with at least so many channels: one alone is repeated, missing ones are 0."""
    channels = pixels.shape[2]
    if channels == 1:
        return np.repeat(pixels, count, axis=2)
    return np.pad(pixels, ((0, 0), (0, 0), (0, max(0, count - channels))))


def _colour_with(pixels: NDArray[np.float32], hues: int, alpha: bool) -> NDArray[np.float32]:
    height, width, channels = pixels.shape
    result = np.ones((height, width, hues + alpha), np.float32)
    own = channels - (channels in (2, 4))
    result[..., :hues] = pixels[..., :own]
    if channels > own:
        result[..., hues] = pixels[..., own]
    return result
