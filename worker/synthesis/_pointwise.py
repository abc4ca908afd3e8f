"""Two pictures made into one, number by number."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from api_schemas.base import FLOAT32_MAX
from worker.images.image import Image
from worker.synthesis._channels import joint_meaning, matched

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from numpy.typing import NDArray

    from api_schemas.families import TextureSpec

    Numbers = NDArray[np.float64]

_ROWS = 64


def combined(a: Image, b: Image | float, function: Callable[[Numbers, Numbers], Numbers]) -> Image:
    """Return function(a, b) of two pictures of one size, or of a picture and a number.

    Channels are brought together first. Sums and products are of float64 numbers; what float32
    cannot hold becomes its largest number, and alpha is held within 0..1.
    """
    if isinstance(b, float):
        b = Image(np.full((a.height, a.width, 1), b, np.float32), "data")
    meaning = joint_meaning(a, b)
    first, second = matched(a, b)
    channels = first.shape[-1]
    pixels: NDArray[np.float32] = np.empty(first.shape, np.float32)
    with np.errstate(all="ignore"):
        for top in range(0, len(pixels), _ROWS):
            rows = slice(top, top + _ROWS)
            pixels[rows] = held(function(wide(first[rows]), wide(second[rows])))
    if meaning == "colour" and channels in (2, 4):
        np.clip(pixels[..., -1], 0, 1, out=pixels[..., -1])
    return Image(pixels, meaning)


def operand(inputs: Mapping[str, Image], name: str, value: TextureSpec | float) -> Image | float:
    """Return what stands for an operand: the picture of its texture, or its number."""
    return value if isinstance(value, float) else inputs[name]


def wide(pixels: NDArray[np.float32]) -> Numbers:
    """Return numbers in float64, what is none taken as 0 and the infinite as the largest."""
    return np.nan_to_num(
        pixels.astype(np.float64), nan=0.0, posinf=FLOAT32_MAX, neginf=-FLOAT32_MAX
    )


def held(numbers: Numbers) -> NDArray[np.float32]:
    """Return numbers in float32, held within what it has."""
    return np.clip(numbers, -FLOAT32_MAX, FLOAT32_MAX).astype(np.float32)
