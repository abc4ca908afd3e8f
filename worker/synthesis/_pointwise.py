"""Two pictures made into one, number by number."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from api_schemas.base import FLOAT32_MAX
from worker.images.image import Image
from worker.synthesis._channels import joint_meaning, matched

if TYPE_CHECKING:
    from collections.abc import Callable

    from numpy.typing import NDArray

    from api_schemas.families import TextureSpec

    Numbers = NDArray[np.float64]

_ROWS = 64


def combined(
    a: Image, b: Image | TextureSpec | float, function: Callable[[Numbers, Numbers], Numbers]
) -> Image:
    """Return function(a, b) of two pictures of one size, or of a picture and a number.

    Channels are brought together first. Sums and products are of float64 numbers; what float32
    cannot hold becomes its largest number, and alpha is held within 0..1.
    """
    if not isinstance(b, Image):
        b = Image(np.full((a.height, a.width, 1), b, np.float32), "data")
    meaning = joint_meaning(a, b)
    first, second = matched(a, b)
    pixels = np.empty(first.shape, np.float32)
    with np.errstate(all="ignore"):
        for top in range(0, len(pixels), _ROWS):
            rows = slice(top, top + _ROWS)
            pixels[rows] = held(function(wide(first[rows]), wide(second[rows])))
    if meaning == "colour" and pixels.shape[2] in (2, 4):
        np.clip(pixels[..., -1], 0, 1, out=pixels[..., -1])
    return Image(pixels, meaning)


def wide(pixels: NDArray[np.float32]) -> Numbers:
    """Return numbers in float64, what is none taken as 0 and the infinite as the largest."""
    return np.nan_to_num(
        pixels.astype(np.float64), nan=0.0, posinf=FLOAT32_MAX, neginf=-FLOAT32_MAX
    )


def held(numbers: Numbers) -> NDArray[np.float32]:
    """Return numbers in float32, held within what it has."""
    return np.clip(numbers, -FLOAT32_MAX, FLOAT32_MAX).astype(np.float32)
