"""The photograph of a mirrored ball, taken from +z from far away (Miller and Hoffman, 1984).

The point (x, y) of the unit ball, with the normal n = (x, y, z), shows 2 z n - (0, 0, 1): its angle
from +z is twice that of n, and the disc's radius is sin(a/2), half that of an equisolid lens.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from worker.layouts import _discs

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from api_schemas.layouts.mirror_ball import MirrorBallSpec

    Numbers = NDArray[np.float64]


def place(spec: MirrorBallSpec, directions: Numbers) -> Numbers:
    """Return (u, v) of directions."""
    return _discs.place(directions, np.eye(3), "equisolid", np.pi)


def direction(spec: MirrorBallSpec, uv: Numbers) -> tuple[Numbers, NDArray[np.bool_]]:
    """Return the directions at places, and which places are on the disc."""
    return _discs.direction(uv, np.eye(3), "equisolid", np.pi)


def solid_angles(spec: MirrorBallSpec, width: int, height: int) -> Numbers:
    """Return the solid angle of each texel, by parts of it."""
    return _discs.solid_angles(width, height, "equisolid", np.pi)
