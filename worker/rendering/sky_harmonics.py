"""Light on matt surfaces as nine numbers, found in a picture of it that nine numbers made."""

import math

import numpy as np
from numpy.typing import NDArray

from api_schemas.sky import LIGHT_FROM_BELOW, SKY_CUBE
from worker import layouts

_TERMS = 9


def harmonics_in(column: NDArray[np.float32]) -> NDArray[np.float64]:
    """Return the coefficients that lib/environment.glsl adds up (Ramamoorthi and Hanrahan, 2001).

    Irradiance by nine harmonics is a quadratic form of the normal. Many texels tell it to more
    digits than float32 has; dark ones may have been below zero, and are left out.

    Args:
        column: float32 (6 side, side, 3), irradiance over pi on a cube, linear.

    Returns:
        float64 (9, 3): of 1, y, z, x, xy, yz, 3zz - 1, xz, xx - yy; 0 of a colour without light.
    """
    height, width = column.shape[:2]
    normals, _ = layouts.direction(SKY_CUBE, layouts.texel_middles(width, height).reshape(-1, 2))
    x, y, z = normals.T
    terms = [np.ones_like(x), y, z, x, x * y, y * z, 3 * z * z - 1, x * z, x * x - y * y]
    rows = np.stack(terms, axis=1)
    light = column.reshape(-1, 3).astype(np.float64)
    found = np.zeros((_TERMS, 3))
    for channel in range(3):
        lit = light[:, channel] > 0
        if np.count_nonzero(lit) >= _TERMS:
            found[:, channel] = np.linalg.lstsq(rows[lit], light[lit, channel], rcond=None)[0]
    return found


def comes_from_below(column: NDArray[np.float32]) -> bool:
    """Tell by irradiance (6 side, side, 3) whether light comes from below more than it ever does.

    Its share along y over the even one is 2/3 of that of the light itself, L1-1 / L00.
    """
    height, width = column.shape[:2]
    towards, _ = layouts.direction(SKY_CUBE, layouts.texel_middles(width, height))
    light = column.sum(axis=2, dtype=np.float64) * layouts.solid_angles(SKY_CUBE, width, height)
    along = float(light.ravel() @ towards[:, 1])
    return 1.5 * math.sqrt(3) * along < LIGHT_FROM_BELOW * float(light.sum())
