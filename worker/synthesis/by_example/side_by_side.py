"""Several exemplars as one picture: they lie beside each other, and what is between is not copied.

Whatever compares patches then finds those of all exemplars and none across an edge. Pictures go on
mirrored between them, so that their edges are not outlines.
"""

from __future__ import annotations

import functools
from dataclasses import dataclass
from typing import TYPE_CHECKING, TypeVar

import numpy as np

from api_schemas.side_by_side import corners, gap, whole
from worker.images.image import Image
from worker.synthesis._channels import matched

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping, Sequence

    from numpy.typing import NDArray

    from worker.synthesis.by_example.arrays import Integers, Mask

Number = TypeVar("Number", bound=np.generic)


@dataclass(frozen=True, slots=True)
class SideBySide:
    """Where exemplars lie in one picture.

    Attributes:
        prefixes: What the names of each one's inputs begin with.
        sizes: Width and height of each.
        columns: The first column of each; all begin in the first row.
    """

    prefixes: tuple[str, ...]
    sizes: tuple[tuple[int, int], ...]
    columns: tuple[int, ...]

    @classmethod
    def of(cls, inputs: Mapping[str, Image]) -> SideBySide:
        """Lay `exemplar` and those of `more_exemplars`, if there are any."""
        names = [name for name in inputs if name.rpartition("/")[2] == "exemplar"]
        prefixes = sorted((name.removesuffix("exemplar") for name in names), key=_place_in_list)
        pictures = [inputs[f"{prefix}exemplar"] for prefix in prefixes]
        sizes = tuple((picture.width, picture.height) for picture in pictures)
        return cls(tuple(prefixes), sizes, tuple(corners(sizes)))

    def parts(self, picture: NDArray[Number]) -> list[NDArray[Number]]:
        """Return what each exemplar covers of a picture, (height, width, ..)."""
        return [
            picture[:height, column : column + width]
            for (width, height), column in zip(self.sizes, self.columns, strict=True)
        ]

    def joined(self, inputs: Mapping[str, Image], name: str) -> Image | None:
        """Return the pictures of a field as one, if the first exemplar has it: all have, then."""
        if name not in inputs:
            return None
        pictures = [inputs[f"{prefix}{name}"] for prefix in self.prefixes]
        if len(pictures) == 1:
            return pictures[0]
        meaning = pictures[0].meaning
        # With the channels of all those before, and then of all there are
        widest = functools.reduce(lambda a, b: Image(matched(a, b)[0][:1, :1], meaning), pictures)
        even = (matched(each, widest)[0] for each in pictures)
        return Image(self._laid(even, widest.channels), meaning)

    def joined_masks(self, masks: Sequence[Mask]) -> Mask:
        """Return what of each is usable as one mask, False between them."""
        width, height = whole(self.sizes)
        found = np.zeros((height, width), bool)
        for part, mask in zip(self.parts(found), masks, strict=True):
            part[...] = mask
        return found

    def which(self, place: Integers) -> Integers:
        """Return the number of the exemplar that each source pixel is of; -1 where kept."""
        rows, columns = np.moveaxis(place, -1, 0)
        found = np.searchsorted(self.columns, columns, "right").astype(np.int32) - 1
        return np.where(rows < 0, np.int32(-1), found)

    def within(self, place: Integers) -> tuple[Integers, Integers]:
        """Return row and column within its own exemplar of each source pixel, and that one's size.

        Each (height, width, 2), rows and heights first.
        """
        if len(self.sizes) == 1:
            return place, np.broadcast_to(np.array(self.sizes[0][::-1], np.int32), place.shape)
        number = self.which(place)
        firsts = np.array([(0, column) for column in self.columns], np.int32)
        sizes = np.array([(height, width) for width, height in self.sizes], np.int32)
        return place - firsts[number], sizes[number]

    def _laid(self, pictures: Iterable[NDArray[np.float32]], channels: int) -> NDArray[np.float32]:
        """Lay pictures with so many channels; what is beside and below them is mirrored."""
        width, height = whole(self.sizes)
        found = np.empty((height, width, channels), np.float32)
        between = gap(self.sizes)
        for pixels, column in zip(pictures, self.columns, strict=True):
            end = min(width, column + pixels.shape[1] + between - between // 2)
            start = max(0, column - between // 2)
            margins = ((0, height - len(pixels)), (column - start, end - column - pixels.shape[1]))
            found[:, start:end] = np.pad(pixels, (*margins, (0, 0)), mode="symmetric")
        return found


def _place_in_list(prefix: str) -> int:
    return int(prefix.split("/")[1]) if prefix else -1
