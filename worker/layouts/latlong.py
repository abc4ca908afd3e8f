"""Longitude and latitude (Blinn and Newell, 1976).

With theta = atan2(z, x), u is theta / 2 pi plus a constant that brings the centre to u = 1/2; no
convention in use mirrors another. v = 1/2 + asin(y) / pi.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from api_schemas.layouts.latlong import LatlongSpec

    Numbers = NDArray[np.float64]

_TURNS = {"-x": 0.0, "+z": 0.25, "+x": 0.5, "-z": 0.75}
"""What is added to theta / 2 pi, by centre."""


def place(spec: LatlongSpec, directions: Numbers) -> Numbers:
    """Return (u, v) of directions; u is in 0 <= u < 1."""
    x, y, z = directions.T
    u = (np.arctan2(z, x) / (2 * np.pi) + _TURNS[spec.centre]) % 1.0
    # atan2 is exact where asin is not, near the poles; and it asks for no unit length.
    v = 0.5 + np.arctan2(y, np.hypot(x, z)) / np.pi
    return np.stack([np.where(u < 1.0, u, 0.0), v], axis=1)


def direction(spec: LatlongSpec, uv: Numbers) -> tuple[Numbers, NDArray[np.bool_]]:
    """Return the unit directions at places; every place holds one."""
    theta = 2 * np.pi * (uv[:, 0] - _TURNS[spec.centre])
    latitude = np.pi * (uv[:, 1] - 0.5)
    across = np.cos(latitude)
    directions = np.stack(
        [np.cos(theta) * across, np.sin(latitude), np.sin(theta) * across], axis=1
    )
    return directions, np.ones(len(uv), bool)


def solid_angles(spec: LatlongSpec, width: int, height: int) -> Numbers:
    """Return (2 pi / width) (sin p1 - sin p0) of each texel, exact."""
    edges = np.sin(np.pi * (0.5 - np.arange(height + 1) / height))
    rows = (edges[:-1] - edges[1:]) * (2 * np.pi / width)
    return np.repeat(rows[:, np.newaxis], width, axis=1)
