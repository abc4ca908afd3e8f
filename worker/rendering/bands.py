"""Rows of a picture and of its layers, put together from the tiles that are drawn."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Self, TypeAlias

import numpy as np
from numpy.typing import NDArray

from worker.images.image import Image
from worker.rendering.cryptomatte import Mattes
from worker.rendering.packing import PICTURE, PLACES, SAMPLED, SHADING_DIFFERENCE
from worker.rendering.targets import Target
from worker.rendering.tiles import Tile, widened

Band: TypeAlias = Mapping[str, Image]
"""Some rows of the picture, as PICTURE, and of each layer that was asked for, by its name."""


@dataclass(frozen=True, slots=True)
class OpenBand:
    """Where the pixels of a band are put together.

    Attributes:
        pixels: Arrays (rows, width, channels) by place.
        numbers: What each sample shows, (rows, width, samples), by the kind of ids.
        mattes: What these numbers mean.
    """

    pixels: dict[str, NDArray[np.float32]]
    numbers: dict[str, NDArray[np.float32]]
    mattes: Mapping[str, Mattes]

    @classmethod
    def empty(
        cls,
        layers: Sequence[str],
        mattes: Mapping[str, Mattes],
        rows: int,
        width: int,
        supersampling: int,
    ) -> Self:
        """Make room for some rows of the picture and of the layers named."""
        placed = [name for name in (PICTURE, *layers) if name in PLACES]
        return cls(
            {name: np.empty((rows, width, PLACES[name].channels), np.float32) for name in placed},
            {name: np.empty((rows, width, supersampling**2), np.float32) for name in mattes},
            mattes,
        )

    def read(self, resolved: Target, tile: Tile) -> None:
        """Copy a tile's part of every layer from OpenGL."""
        columns = slice(tile.left, tile.left + tile.width)
        for attachment in {PLACES[name].attachment for name in self.pixels}:
            numbers = resolved.read(attachment, tile.width, tile.height)
            for name, pixels in self.pixels.items():
                place = PLACES[name]
                if place.attachment == attachment:
                    pixels[:, columns] = numbers[..., place.start : place.end]

    def read_samples(self, samples: Target, tile: Tile, supersampling: int, apron: int) -> None:
        """Copy what each of a tile's samples shows from OpenGL, but for the apron of pixels."""
        columns = slice(tile.left, tile.left + tile.width)
        seen = widened(tile, apron)
        inner = slice(apron * supersampling, -apron * supersampling or None)
        for name, numbers in self.numbers.items():
            place = SAMPLED[name]
            size = (seen.width * supersampling, seen.height * supersampling)
            drawn = samples.read(place.attachment, *size)[inner, inner, place.start]
            blocks = drawn.reshape(tile.height, supersampling, tile.width, supersampling)
            numbers[:, columns] = blocks.transpose(0, 2, 1, 3).reshape(tile.height, tile.width, -1)

    def subtract(self, samples: Target, tile: Tile) -> None:
        """Take a picture of one sample for each pixel away from the difference."""
        columns = slice(tile.left, tile.left + tile.width)
        picture = samples.read(0, tile.width, tile.height)
        self.pixels[SHADING_DIFFERENCE][:, columns] -= picture[..., :3]

    def images(self) -> Band:
        """Return the finished rows."""
        found = {name: Image(pixels, PLACES[name].meaning) for name, pixels in self.pixels.items()}
        for name, numbers in self.numbers.items():
            found |= self.mattes[name].images(numbers)
        return found
