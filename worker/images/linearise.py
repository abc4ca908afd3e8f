"""From the numbers a decoder gives to linear light."""

from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from worker.images.codes import Transfer, linear_from_codes
from worker.images.colour import linear_from_srgb, premultiply, unpremultiply
from worker.images.image import Meaning

Alpha = Literal["none", "straight", "associated"]


def linearise(
    decoded: NDArray[Any], transfer: Transfer, alpha: Alpha, meaning: Meaning
) -> NDArray[np.float32]:
    """Undo the file's encoding; for colour associate alpha exactly once, in linear light.

    Args:
        decoded: uint8, uint16 or float32, shape (H, W, C).
        transfer: The curve of every channel but alpha, which never has one.
        alpha: What the last channel is. "associated" with "srgb" means that encoded values were
            multiplied, so they are divided before they are decoded.
        meaning: Data keeps its numbers apart: nothing is multiplied by anything.
    """
    if transfer == "linear":
        pixels = _numbers(decoded)
        return premultiply(pixels) if meaning == "colour" and alpha == "straight" else pixels
    if alpha == "none":
        return _from_srgb(decoded)
    if alpha == "associated" and meaning == "colour":
        decoded = unpremultiply(_numbers(decoded))
    pixels = _from_srgb(decoded)
    pixels[..., -1:] = _numbers(decoded[..., -1:])
    return premultiply(pixels) if meaning == "colour" else pixels


def _numbers(decoded: NDArray[Any]) -> NDArray[np.float32]:
    return decoded if decoded.dtype == np.float32 else linear_from_codes(decoded, "linear")


def _from_srgb(decoded: NDArray[Any]) -> NDArray[np.float32]:
    if decoded.dtype == np.float32:
        return linear_from_srgb(decoded)
    return linear_from_codes(decoded, "srgb")
