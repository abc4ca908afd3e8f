"""One disc, touching the sides of a square picture, towards an axis."""

from __future__ import annotations

from typing import TYPE_CHECKING

from worker.layouts._density import sum_of_parts
from worker.layouts._disc import disc_density, from_disc, on_disc

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from worker.layouts._disc import Model

    Numbers = NDArray[np.float64]


def place(directions: Numbers, picture_from_world: Numbers, model: Model, rim: float) -> Numbers:
    """Return (u, v) of directions."""
    return 0.5 + 0.5 * on_disc(directions @ picture_from_world.T, model, rim)


def direction(
    uv: Numbers, picture_from_world: Numbers, model: Model, rim: float
) -> tuple[Numbers, NDArray[np.bool_]]:
    """Return the directions at places, and which places are on the disc."""
    local, valid = from_disc(2 * uv - 1, model, rim)
    return local @ picture_from_world, valid


def solid_angles(width: int, height: int, model: Model, rim: float) -> Numbers:
    """Return the solid angle of each texel."""
    return sum_of_parts(lambda uv: 4 * disc_density(2 * uv - 1, model, rim), width, height)
