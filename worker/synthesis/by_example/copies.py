"""What a coordinate map copies whole: lines of pixels that lie in the exemplar as in the result."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Mask = NDArray[np.bool_]
    Integers = NDArray[np.int32]


def continued(place: Integers) -> tuple[Mask, Mask]:
    """Return which pixels continue their left, and which their upper neighbour."""
    made = place[..., 0] >= 0
    across, down = np.zeros(made.shape, bool), np.zeros(made.shape, bool)
    across[:, 1:] = (np.diff(place, axis=1) == (0, 1)).all(axis=-1) & made[:, 1:] & made[:, :-1]
    down[1:] = (np.diff(place, axis=0) == (1, 0)).all(axis=-1) & made[1:] & made[:-1]
    return across, down


def copied_so_far(goes_on: Mask) -> Integers:
    """Return how long each line along axis 1 has become at a pixel, the pixel included."""
    places = np.arange(goes_on.shape[1], dtype=np.int32)
    starts = np.maximum.accumulate(np.where(goes_on, np.int32(0), places), axis=1)
    return np.asarray(places - starts + 1, np.int32)
