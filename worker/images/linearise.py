"""From the numbers a decoder gives to linear light."""

from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from api_schemas.families import Meaning
from worker.images.codes import Transfer, linear_from_codes
from worker.images.colour import linear_from_srgb, premultiply, unpremultiply

Alpha = Literal["none", "straight", "associated"]


_BLOCK_TEXELS = 1 << 16


# Pictures may hold infinity and NaN.
@np.errstate(over="ignore", invalid="ignore")
def linearise(
    decoded: NDArray[Any],
    transfer: Transfer,
    alpha: Alpha,
    meaning: Meaning,
    rec709: NDArray[np.float64] | None = None,
) -> NDArray[np.float32]:
    """Undo the file's encoding; for colour associate alpha exactly once, in linear light.

    Args:
        decoded: uint8, uint16 or float32, shape (H, W, C). A float32 array is changed in place.
        transfer: The curve of every channel but alpha, which never has one.
        alpha: What the last channel is. "associated" with "srgb" means that encoded values were
            multiplied, so they are divided before they are decoded.
        meaning: Data keeps its numbers apart: nothing is multiplied by anything.
        rec709: From the linear RGB of colour to Rec.709, if it is something else.
    """
    pixels = decoded if decoded.dtype == np.float32 else np.empty(decoded.shape, np.float32)
    # Some rows at a time: the largest pictures leave no room for whole copies.
    step = max(1, _BLOCK_TEXELS // decoded.shape[1])
    for start in range(0, decoded.shape[0], step):
        rows = slice(start, start + step)
        light = _decode(decoded[rows], transfer, alpha, meaning)
        if rec709 is not None and meaning == "colour":
            light[..., :3] = light[..., :3] @ rec709.astype(np.float32).T
        pixels[rows] = light
    return pixels


def _decode(
    decoded: NDArray[Any], transfer: Transfer, alpha: Alpha, meaning: Meaning
) -> NDArray[np.float32]:
    if transfer == "linear":
        light = _numbers(decoded)
        return premultiply(light) if meaning == "colour" and alpha == "straight" else light
    if alpha == "none":
        return _from_srgb(decoded)
    if alpha == "associated" and meaning == "colour":
        decoded = unpremultiply(_numbers(decoded))
    light = _from_srgb(decoded)
    light[..., -1:] = _numbers(decoded[..., -1:])
    return premultiply(light) if meaning == "colour" else light


def _numbers(decoded: NDArray[Any]) -> NDArray[np.float32]:
    return decoded if decoded.dtype == np.float32 else linear_from_codes(decoded, "linear")


def _from_srgb(decoded: NDArray[Any]) -> NDArray[np.float32]:
    if decoded.dtype == np.float32:
        return linear_from_srgb(decoded)
    return linear_from_codes(decoded, "srgb")
