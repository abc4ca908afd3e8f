"""The one voxel type inside the worker."""

from dataclasses import dataclass
from typing import Self

import numpy as np
from numpy.typing import NDArray

from api_schemas.families import Meaning
from worker.images.image import Image


@dataclass(frozen=True, slots=True)
class Volume:
    """A texture that fills a cube: linear light in Rec.709 primaries, or plain numbers.

    The array is not copied: treat it as read-only.

    Attributes:
        voxels: float32, shape (depth, height, width, channels), channels 1..4. The centre of voxel
            (slice s, row r, column c) has u = (c + .5)/width, v = 1 - (r + .5)/height and
            w = (s + .5)/depth: each slice is a picture with row 0 at its top.
        meaning: As of an Image.

    Raises:
        TypeError: The voxels are not a float32 array.
        ValueError: The shape is not (depth >= 1, height >= 1, width >= 1, channels 1..4), or the
            meaning is neither "colour" nor "data".
    """

    voxels: NDArray[np.float32]
    meaning: Meaning

    def __post_init__(self) -> None:
        """Refuse what is not a volume."""
        if not isinstance(self.voxels, np.ndarray) or self.voxels.dtype != np.float32:
            kind = getattr(self.voxels, "dtype", type(self.voxels).__name__)
            raise TypeError(f"voxels are {kind}; they must be a float32 array")
        shape = self.voxels.shape
        if len(shape) != 4 or 0 in shape or shape[3] > 4:
            raise ValueError(f"voxels have shape {shape}; it must be (depth, height, width, 1..4)")
        if self.meaning not in ("colour", "data"):
            raise ValueError("meaning must be 'colour' or 'data'")

    @property
    def depth(self) -> int:
        """Slices."""
        return int(self.voxels.shape[0])

    @property
    def height(self) -> int:
        """Rows."""
        return int(self.voxels.shape[1])

    @property
    def width(self) -> int:
        """Columns."""
        return int(self.voxels.shape[2])

    @property
    def channels(self) -> int:
        """Numbers per voxel, 1..4."""
        return int(self.voxels.shape[3])

    def slice(self, index: int) -> Image:
        """Return one slice as a picture that shares its numbers."""
        return Image(self.voxels[index], self.meaning)

    def stacked(self) -> Image:
        """Return all slices below each other, the first one on top, sharing their numbers."""
        shape = (self.depth * self.height, self.width, self.channels)
        return Image(self.voxels.reshape(shape), self.meaning)

    @classmethod
    def unstacked(cls, image: Image, depth: int) -> Self:
        """Cut what `stacked` gives into so many slices of equal height."""
        shape = (depth, image.height // depth, image.width, image.channels)
        return cls(image.pixels.reshape(shape), image.meaning)
