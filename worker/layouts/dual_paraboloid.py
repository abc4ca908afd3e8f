"""What two parabolic mirrors show (Heidrich and Seidel, 1998).

The mirror z = 1/2 - (x^2 + y^2) / 2 reflects parallel rays at (x, y) to
(2x, 2y, 1 - x^2 - y^2) / (1 + x^2 + y^2): a stereographic projection.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from worker.layouts._density import sum_of_parts
from worker.layouts._pairs import Pair

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from api_schemas.layouts.dual_paraboloid import DualParaboloidSpec

    Numbers = NDArray[np.float64]


def place(spec: DualParaboloidSpec, directions: Numbers) -> Numbers:
    """Return (u, v) of directions."""
    return _pair(spec).place(directions)


def direction(spec: DualParaboloidSpec, uv: Numbers) -> tuple[Numbers, NDArray[np.bool_]]:
    """Return the directions at places, and which places are on a disc."""
    return _pair(spec).direction(uv)


def solid_angles(spec: DualParaboloidSpec, width: int, height: int) -> Numbers:
    """Return the solid angle of each texel, by parts of it."""
    return sum_of_parts(_pair(spec).density, width, height)


def _pair(spec: DualParaboloidSpec) -> Pair:
    return Pair(np.eye(3), "stereographic", flipped=spec.second == "photograph")
