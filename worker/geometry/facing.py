"""Which way a flat shape faces, and where its texture's right and up are."""

from typing import Literal

import numpy as np
from numpy.typing import NDArray

Facing = Literal["+x", "-x", "+y", "-y", "+z", "-z"]

_UP: dict[Facing, tuple[int, int, int]] = {
    "+x": (0, 1, 0),
    "-x": (0, 1, 0),
    "+z": (0, 1, 0),
    "-z": (0, 1, 0),
    "+y": (0, 0, -1),
    "-y": (0, 0, 1),
}


def axes(facing: Facing) -> NDArray[np.float64]:
    """Return the rows right, up, normal of the frame in which the texture reads from outside.

    Walls have y up. Floor and lid face +y with their upper edge at the back, as one sees them from
    the front; a face towards -y has its upper edge in front. right = up x normal.
    """
    normal = np.zeros(3)
    normal["xyz".index(facing[1])] = 1.0 if facing[0] == "+" else -1.0
    up = np.array(_UP[facing], dtype=np.float64)
    return np.stack([np.cross(up, normal), up, normal])
