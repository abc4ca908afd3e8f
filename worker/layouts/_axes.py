"""How a picture stands that is taken towards each axis: what is to its right, and what is up.

Right as seen from within: right = forward x up. OpenEXR's cube faces stand so.
"""

from __future__ import annotations

import numpy as np

AXES = {
    "+x": ((1, 0, 0), (0, 0, 1), (0, 1, 0)),
    "-x": ((-1, 0, 0), (0, 0, -1), (0, 1, 0)),
    "+y": ((0, 1, 0), (1, 0, 0), (0, 0, 1)),
    "-y": ((0, -1, 0), (1, 0, 0), (0, 0, -1)),
    "+z": ((0, 0, 1), (-1, 0, 0), (0, 1, 0)),
    "-z": ((0, 0, -1), (1, 0, 0), (0, 1, 0)),
}
"""Forward, right and up of each."""


def picture_from_world(towards: str) -> np.ndarray:
    """Return the rows right, up and forward of a picture taken towards an axis, (3, 3)."""
    forward, right, up = AXES[towards]
    return np.array([right, up, forward], dtype=np.float64)
