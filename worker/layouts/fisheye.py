"""What lenses with very wide angles see, by the four models of lens makers."""

from __future__ import annotations

from typing import TYPE_CHECKING

from worker.layouts import _discs
from worker.layouts._axes import picture_from_world

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from api_schemas.layouts.fisheye import FisheyeSpec

    Numbers = NDArray[np.float64]


def place(spec: FisheyeSpec, directions: Numbers) -> Numbers:
    """Return (u, v) of directions."""
    return _discs.place(directions, picture_from_world(spec.towards), spec.model, spec.angle / 2)


def direction(spec: FisheyeSpec, uv: Numbers) -> tuple[Numbers, NDArray[np.bool_]]:
    """Return the directions at places, and which places are on the disc."""
    return _discs.direction(uv, picture_from_world(spec.towards), spec.model, spec.angle / 2)


def solid_angles(spec: FisheyeSpec, width: int, height: int) -> Numbers:
    """Return the solid angle of each texel, by parts of it."""
    return _discs.solid_angles(width, height, spec.model, spec.angle / 2)
