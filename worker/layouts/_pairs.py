"""Two discs side by side, each with one half of all directions."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from worker.layouts._disc import disc_density, from_disc, on_disc

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from worker.layouts._disc import Model

    Numbers = NDArray[np.float64]

_QUARTER = np.pi / 2


@dataclass(frozen=True, slots=True, eq=False)
class Pair:
    """How the discs lie.

    Attributes:
        frame: Rows right, up and forward of the first disc.
        model: How angles become distances from the middle of a disc.
        flipped: Whether right is left on the second disc.
    """

    frame: Numbers
    model: Model
    flipped: bool

    def place(self, directions: Numbers) -> Numbers:
        """Return (u, v) of directions."""
        local = directions @ self.frame.T
        second = local[:, 2] < 0
        local[:, 2] = np.abs(local[:, 2])
        local[:, 0] = np.where(second & self.flipped, -local[:, 0], local[:, 0])
        uv = 0.5 + 0.5 * on_disc(local, self.model, _QUARTER)
        return np.stack([0.5 * (uv[:, 0] + second), uv[:, 1]], axis=1)

    def direction(self, uv: Numbers) -> tuple[Numbers, NDArray[np.bool_]]:
        """Return the directions at places, and which places are on a disc."""
        second = uv[:, 0] >= 0.5
        local, valid = from_disc(_on_their_disc(uv), self.model, _QUARTER)
        local[:, 0] = np.where(second & self.flipped, -local[:, 0], local[:, 0])
        local[:, 2] = np.where(second, -local[:, 2], local[:, 2])
        return local @ self.frame, valid

    def density(self, uv: Numbers) -> Numbers:
        """Return steradians per unit of the picture's area."""
        return 8 * disc_density(_on_their_disc(uv), self.model, _QUARTER)


def _on_their_disc(uv: Numbers) -> Numbers:
    """Return places within the square round a disc, -1..1."""
    return np.stack([4 * uv[:, 0] - np.where(uv[:, 0] >= 0.5, 3.0, 1.0), 2 * uv[:, 1] - 1], axis=1)
