"""The direction of the edges in a picture, by its structure tensor (Foerstner and Guelch, 1987)."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from worker.synthesis.blur import smooth

if TYPE_CHECKING:
    from numpy.typing import NDArray


def directions_of(picture: NDArray[np.float64], radius: float) -> NDArray[np.float64]:
    """Return the angle, counter-clockwise from u, along which a picture changes least.

    Args:
        picture: (height, width), row 0 the top; its edges are joined.
        radius: Standard deviation, in tiles, of the neighbourhood that is looked at.
    """
    height, width = picture.shape
    # Differences per tile, v up
    along_u = (np.roll(picture, -1, 1) - np.roll(picture, 1, 1)) * width
    along_v = (np.roll(picture, 1, 0) - np.roll(picture, -1, 0)) * height
    uu, vv, uv = (
        smooth(product, (radius, radius))
        for product in (along_u * along_u, along_v * along_v, along_u * along_v)
    )
    steepest = 0.5 * np.arctan2(2 * uv, uu - vv)
    flat = (uu + vv) < 1e-20
    angle: NDArray[np.float64] = np.where(flat, 0.0, steepest + np.pi / 2)
    return angle
