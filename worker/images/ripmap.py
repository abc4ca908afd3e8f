"""A picture at all powers of two smaller along u and v each on their own, in one table."""

import numpy as np
from numpy.typing import NDArray

from api_schemas.families import Wrap
from worker.images.pyramids import halve_height, halve_width


def ripmap(pixels: NDArray[np.float32]) -> list[list[NDArray[np.float32]]]:
    """Give the box means: item [j][i] is halved i times along u and j times along v.

    W x H texels, both powers of two, become (2W - 1) (2H - 1).

    Args:
        pixels: float32 (H, W, C), linear light, alpha premultiplied. Item [0][0] is this array.
    """
    rows = [[pixels]]
    while rows[-1][0].shape[0] > 1:
        rows.append([halve_height(rows[-1][0])])
    for row in rows:
        while row[-1].shape[1] > 1:
            row.append(halve_width(row[-1]))
    return rows


def ripmap_table(
    rows: list[list[NDArray[np.float32]]], wrap: tuple[Wrap, Wrap], border: tuple[float, ...]
) -> NDArray[np.float32]:
    """Lay the pictures of a ripmap beside and below each other for sample_ripmap.glsl.

    Each has a frame of one texel that holds what lies beyond its edges, so that reading between
    texels needs no neighbour. The largest is at the lower left; those halved along u are on its
    right, those halved along v above it.

    Returns:
        float32 (sum of H_j + 2, sum of W_i + 2, C), the uppermost row first.
    """
    lines = [np.concatenate([_framed(item, wrap, border) for item in row], axis=1) for row in rows]
    return np.concatenate(lines[::-1], axis=0)


def _framed(
    pixels: NDArray[np.float32], wrap: tuple[Wrap, Wrap], border: tuple[float, ...]
) -> NDArray[np.float32]:
    for axis, mode in ((1, wrap[0]), (0, wrap[1])):
        pixels = beyond(pixels, axis, mode, border)
    return pixels


def beyond(
    pixels: NDArray[np.float32], axis: int, wrap: Wrap, border: tuple[float, ...]
) -> NDArray[np.float32]:
    """Add the texel beyond each end of an axis: the other end's, the same, or the border."""
    widths = [(0, 0)] * pixels.ndim
    widths[axis] = (1, 1)
    if wrap != "border":
        return np.pad(pixels, widths, mode="wrap" if wrap == "repeat" else "edge")
    framed = np.pad(pixels, widths)
    ends = framed.swapaxes(0, axis)
    ends[[0, -1]] = np.array(border[: pixels.shape[2]], np.float32)
    return framed
