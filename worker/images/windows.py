"""How the texels of a file lie in the picture a user sees: windows and turns."""

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray


@dataclass(frozen=True, slots=True)
class Window:
    """A rectangle of texels, x to the right and y downwards."""

    x: int
    y: int
    width: int
    height: int


def place(pixels: NDArray[Any], data: Window, display: Window) -> NDArray[Any]:
    """Cut and pad texels stored for the data window to the display window; the rest is 0."""
    if data == display:
        return pixels
    placed = np.zeros((display.height, display.width, pixels.shape[2]), pixels.dtype)
    left, right = max(data.x, display.x), min(data.x + data.width, display.x + display.width)
    top, bottom = max(data.y, display.y), min(data.y + data.height, display.y + display.height)
    if left < right and top < bottom:
        placed[top - display.y : bottom - display.y, left - display.x : right - display.x] = pixels[
            top - data.y : bottom - data.y, left - data.x : right - data.x
        ]
    return placed


def turn(pixels: NDArray[Any], orientation: int) -> NDArray[Any]:
    """Turn stored rows to the upright picture.

    Args:
        pixels: Shape (rows, columns, channels) as stored.
        orientation: The tag of TIFF 6.0 and Exif 2.32, 1..8: where the first row and column
            belong. From 5 on rows become columns. Any other number means upright.
    """
    turned = pixels.swapaxes(0, 1) if orientation in (5, 6, 7, 8) else pixels
    if orientation in (3, 4, 7, 8):
        turned = turned[::-1]
    if orientation in (2, 3, 6, 7):
        turned = turned[:, ::-1]
    return np.ascontiguousarray(turned)
