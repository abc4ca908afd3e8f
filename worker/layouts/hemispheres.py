"""Above and below as discs seen from far away (Hughes et al., 2013, section 20.4)."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from worker.layouts._pairs import Pair

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from api_schemas.layouts.hemispheres import HemispheresSpec

    Numbers = NDArray[np.float64]

_FRAME = np.array([[1.0, 0, 0], [0, 0, 1], [0, 1, 0]])


def place(spec: HemispheresSpec, directions: Numbers) -> Numbers:
    """Return (u, v) of directions."""
    return _pair(spec).place(directions)


def direction(spec: HemispheresSpec, uv: Numbers) -> tuple[Numbers, NDArray[np.bool_]]:
    """Return the directions at places, and which places are on a disc."""
    return _pair(spec).direction(uv)


def solid_angles(spec: HemispheresSpec, width: int, height: int) -> Numbers:
    """Return the solid angle of each texel, exact, although it has no bound at the rim."""
    edges = 4 * np.arange(width + 1) / width
    z = 1 - 2 * np.arange(height + 1) / height
    found = np.zeros((height, width))
    for middle in (1, 3):
        corners = _ball_above(*np.meshgrid(np.clip(edges - middle, -1, 1), z))
        found += np.diff(corners[:-1] - corners[1:], axis=1)
    return np.maximum(found, 0.0)


def _pair(spec: HemispheresSpec) -> Pair:
    return Pair(_FRAME, "orthographic", flipped=spec.second == "photograph")


def _ball_above(x: Numbers, z: Numbers) -> Numbers:
    """Return the area of the unit ball above the rectangle from (0, 0) to (x, z), with its sign.

    A strip of the disc has pi times its width (Archimedes); what lies beyond both x and z is in
    neither strip outside the disc.
    """
    across, along = np.abs(x), np.abs(z)
    squared = 1 - across**2 - along**2
    height = np.sqrt(np.maximum(squared, 1e-300))
    inside = (
        across * np.arctan2(along, height)
        + along * np.arctan2(across, height)
        - np.arctan(across * along / height)
    )
    outside = np.pi / 2 * (across + along - 1)
    return np.sign(x * z) * np.where(squared > 0, inside, outside)
