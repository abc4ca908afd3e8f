"""All directions on one disc, by their angle from the middle (Debevec, 1998)."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from worker.layouts import _discs

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from api_schemas.layouts.angular_probe import AngularProbeSpec

    Numbers = NDArray[np.float64]

_FRAMES = {"-z": np.diag([1.0, 1.0, -1.0]), "+z": np.eye(3)}
"""Right, up and forward, by what is in the middle; x is to the right either way."""


def place(spec: AngularProbeSpec, directions: Numbers) -> Numbers:
    """Return (u, v) of directions."""
    return _discs.place(directions, _FRAMES[spec.centre], "equidistant", np.pi)


def direction(spec: AngularProbeSpec, uv: Numbers) -> tuple[Numbers, NDArray[np.bool_]]:
    """Return the directions at places, and which places are on the disc."""
    return _discs.direction(uv, _FRAMES[spec.centre], "equidistant", np.pi)


def solid_angles(spec: AngularProbeSpec, width: int, height: int) -> Numbers:
    """Return the solid angle of each texel, by parts of it."""
    return _discs.solid_angles(width, height, "equidistant", np.pi)
