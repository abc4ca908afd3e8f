"""T39: the checkered plane to the horizon, and what a pixel-wide box makes of it exactly."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

SIDE = 512
FOCAL = 200.0
"""Pixels; the eye is 1 above the plane and looks along it."""
LINES = 512
"""Into which a row of pixels is cut."""
FILTERS = ("nearest", "bilinear", "trilinear", "ripmap", "summed_area", "ewa", "anisotropic")


def triangle_wave(x: NDArray[np.float64]) -> NDArray[np.float64]:
    """The integral from 0 of +1 on even and -1 on odd unit squares."""
    wave: NDArray[np.float64] = 1 - np.abs(1 - x % 2)
    return wave


def exact_plane() -> NDArray[np.float64]:
    """Each pixel's mean below the horizon, (SIDE / 2, SIDE), of squares that are 1 and 0.

    z = f / y and x = z (column - middle) / f. Along a row the mean of +-1 over [a, b] is
    (T(b) - T(a)) / (b - a); down a row lines are added up.
    """
    rows = np.arange(SIDE // 2)[:, None] + (np.arange(LINES) + 0.5) / LINES
    z = FOCAL / rows
    sign = np.where(np.floor(z).astype(np.int64) % 2 == 0, 1.0, -1.0)
    columns = np.arange(SIDE + 1) - SIDE / 2
    means = np.empty((SIDE // 2, SIDE))
    for row in range(SIDE // 2):
        edges = z[row, :, None] * columns / FOCAL
        across = np.diff(triangle_wave(edges), axis=1) / (z[row, :, None] / FOCAL)
        means[row] = (across * sign[row, :, None]).mean(axis=0)
    return 0.5 + 0.5 * means


def squares() -> NDArray[np.float64]:
    """Four squares as a texture: the one at the lower left is 1, as at x = 0..1, z = 0..1."""
    sign = np.where(np.arange(SIDE) < SIDE // 2, 1.0, -1.0)
    return 0.5 + 0.5 * sign[::-1, None] * sign


def plane_scene(color: Any) -> dict[str, Any]:
    """The plane with a colour; a map's tile is 2 x 2 squares."""
    return {
        "camera": {
            "type": "perspective",
            "fov_y": float(2 * np.arctan(SIDE / 2 / FOCAL)),
            "pose": {"eye": [0.0, 1.0, 0.0], "target": [0.0, 1.0, -1.0]},
        },
        "nodes": [
            {
                "mesh": {"type": "infinite_plane", "tile": [2.0, 2.0]},
                "surface": {"technique": "unlit", "color": color},
            }
        ],
    }


def rms(drawn: NDArray[np.floating], exact: NDArray[np.float64]) -> float:
    """How far a picture's lower half is from the exact one."""
    return float(np.sqrt(np.mean((drawn[SIDE // 2 :, :, 0] - exact) ** 2)))
