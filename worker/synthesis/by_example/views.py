"""An exemplar as it lies, turned by quarters and mirrored: eight views of the same pixels.

View k is turned k mod 4 times anticlockwise; from 4 on it is mirrored left to right before. A spot
is a pixel of a view: (view, row, column). Spots may lie beyond the edges of a view, where the
nearest pixel stands for them.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from worker.synthesis.by_example.exemplar import Exemplar

    Bytes = NDArray[np.uint8]
    Mask = NDArray[np.bool_]
    Integers = NDArray[np.int64]

_TURNS = 4


def turned(pixels: NDArray[np.generic], view: int) -> NDArray[np.generic]:
    """Return a picture, (height, width, ..), as a view shows it."""
    return np.rot90(pixels[:, ::-1] if view >= _TURNS else pixels, view % _TURNS)


def turned_normals(normals: NDArray[np.float32], views: Integers) -> NDArray[np.float32]:
    """Turn the first two of three components with the views that pixels are from.

    Args:
        normals: x to the right, y up and z towards the eye, (height, width, 3).
        views: Which view each pixel is from, (height, width).
    """
    x, y, z = np.moveaxis(normals, -1, 0)
    x = np.where(views >= _TURNS, -x, x)
    turns = views % _TURNS
    along = np.choose(turns, [x, -y, -x, y])
    upwards = np.choose(turns, [y, x, -y, -x])
    return np.stack([along, upwards, z], axis=-1)


@dataclass(frozen=True, slots=True)
class Views:
    """Some views of an exemplar, one behind the other.

    Attributes:
        names: Which views, in ascending order.
        usable: What of each may be copied.
        features: Of all pixels, (pixels, channels).
        places: Their rows and columns in the exemplar, (pixels, 2).
        shapes: Height and width of each view, at its number, (8, 2).
        firsts: Its first pixel, (8,).
    """

    names: tuple[int, ...]
    usable: tuple[Mask, ...]
    features: Bytes
    places: Integers
    shapes: Integers
    firsts: Integers

    @classmethod
    def of(cls, exemplar: Exemplar, *, turns: bool, flips: bool) -> Views:
        """Show an exemplar in all ways that are allowed."""
        ways = range(_TURNS) if turns else (0,)
        names = tuple(mirror + way for mirror in ((0, _TURNS) if flips else (0,)) for way in ways)
        places = np.moveaxis(np.indices(exemplar.shape), 0, -1)
        shown = [turned(places, view) for view in names]
        shapes, firsts = np.ones((8, 2), np.int64), np.zeros(8, np.int64)
        for index, (view, there) in enumerate(zip(names, shown, strict=True)):
            shapes[view] = there.shape[:2]
            firsts[view] = index * places[..., 0].size
        flat = np.concatenate([there.reshape(-1, 2) for there in shown])
        usable = tuple(np.asarray(turned(exemplar.usable, view), bool) for view in names)
        features = exemplar.features[flat[:, 0], flat[:, 1]]
        return cls(names, usable, features, flat, shapes, firsts)

    def planes(self, view: int) -> NDArray[np.float64]:
        """Return the features of one view, (channels, height, width)."""
        height, width = self.shapes[view]
        first = self.firsts[view]
        flat = self.features[first : first + height * width].astype(np.float64)
        return flat.T.reshape(-1, height, width)

    def colours(self, spots: Integers) -> NDArray[np.int64]:
        """Return the features of spots, (.., channels)."""
        return self.features[self.pixels(spots)].astype(np.int64)

    def sources(self, spots: Integers) -> NDArray[np.int32]:
        """Return the row and column in the exemplar of spots, (.., 2)."""
        return self.places[self.pixels(spots)].astype(np.int32)

    def pixels(self, spots: Integers) -> Integers:
        """Return the numbers among all pixels of spots, (..)."""
        view, row, column = np.moveaxis(spots, -1, 0)
        height, width = np.moveaxis(self.shapes[view], -1, 0)
        rows, columns = np.clip(row, 0, height - 1), np.clip(column, 0, width - 1)
        found: Integers = self.firsts[view] + rows * width + columns
        return found


def square(corner: Sequence[int], side: int, margin: int = 0) -> Integers:
    """Return the spots of a square of a view, and of a margin around it, (rows, columns, 3)."""
    steps = np.arange(-margin, side + margin)
    spots = np.empty((len(steps), len(steps), 3), np.int64)
    spots[..., 0] = corner[0]
    spots[..., 1] = corner[1] + steps[:, np.newaxis]
    spots[..., 2] = corner[2] + steps
    return spots
