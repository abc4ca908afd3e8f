"""The patches of a target: where they lie, which pixels they hold, and who holds a pixel."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Bytes = NDArray[np.uint8]
    Mask = NDArray[np.bool_]
    Integers = NDArray[np.int32]


class Cover(NamedTuple):
    """Which patches of an axis cover a pixel: `patches[i, k]`, of which it is pixel `inner[i, k]`.

    Both (length, most), and -1 where there are fewer than the most.
    """

    patches: Integers
    inner: Integers


@dataclass(frozen=True, slots=True)
class PatchGrid:
    """Square patches at multiples of a stride.

    Attributes:
        size: Height and width of the target.
        side: Of a patch, in pixels.
        stride: Pixels from one patch to the next.
        wraps: Whether what hangs over the edges goes on at the opposite ones.
    """

    size: tuple[int, int]
    side: int
    stride: int
    wraps: bool

    @property
    def counts(self) -> tuple[int, int]:
        """Rows and columns of patches: every pixel is held by at least one."""
        height, width = (length if self.wraps else length - self.side + 1 for length in self.size)
        if self.wraps:
            return -(-height // self.stride), -(-width // self.stride)
        return -(-(height - 1) // self.stride) + 1, -(-(width - 1) // self.stride) + 1

    def padded(self, features: Bytes) -> Bytes:
        """Return features (height, width, channels) with the margin that patches hang over."""
        margins = [
            (0, max(0, (count - 1) * self.stride + self.side - length))
            for count, length in zip(self.counts, self.size, strict=True)
        ]
        return np.pad(features, [*margins, (0, 0)], mode="wrap" if self.wraps else "edge")

    def cover(self, axis: int) -> Cover:
        """Find the patches that hold each pixel of an axis."""
        length = self.size[axis]
        found: list[list[tuple[int, int]]] = [[] for _ in range(length)]
        for patch in range(self.counts[axis]):
            for inner in range(self.side):
                place = patch * self.stride + inner
                if self.wraps or place < length:
                    found[place % length].append((patch, inner))
        most = max(map(len, found))
        table = np.full((length, most, 2), -1, np.int32)
        for place, entries in enumerate(found):
            table[place, : len(entries)] = np.array(entries, np.int32).reshape(-1, 2)
        return Cover(np.ascontiguousarray(table[..., 0]), np.ascontiguousarray(table[..., 1]))

    def holding(self, pixels: Mask) -> Mask:
        """Return which patches, (rows, columns), hold any of the pixels (height, width)."""
        if pixels.all():
            return np.ones(self.counts, bool)
        tall = np.zeros((self.counts[0], self.size[1]), bool)
        for inner in range(self.side):
            tall |= np.take(pixels, self._places(0, inner), axis=0)
        held = np.zeros(self.counts, bool)
        for inner in range(self.side):
            held |= np.take(tall, self._places(1, inner), axis=1)
        return held

    def breaks(self, rows: Integers, columns: Integers) -> Mask:
        """Return which patches do not continue a neighbour in the source."""
        broken = np.zeros(rows.shape, bool)
        across = (np.diff(rows, axis=1) != 0) | (np.diff(columns, axis=1) != self.stride)
        down = (np.diff(rows, axis=0) != self.stride) | (np.diff(columns, axis=0) != 0)
        broken[:, 1:] |= across
        broken[:, :-1] |= across
        broken[1:] |= down
        broken[:-1] |= down
        return broken

    def _places(self, axis: int, inner: int) -> NDArray[np.int64]:
        places = np.arange(self.counts[axis]) * self.stride + inner
        length = self.size[axis]
        return places % length if self.wraps else np.minimum(places, length - 1)
