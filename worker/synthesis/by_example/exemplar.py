"""What is copied from: a picture, which of its pixels may be copied, and how it is compared."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from worker.errors import RenderError
from worker.synthesis.by_example.features import FeatureSpace, usable, with_channels
from worker.synthesis.by_example.side_by_side import SideBySide

if TYPE_CHECKING:
    from collections.abc import Mapping

    import numpy as np
    from numpy.typing import NDArray

    from worker.images.image import Image

    Bytes = NDArray[np.uint8]
    Mask = NDArray[np.bool_]


@dataclass(frozen=True, slots=True)
class Exemplar:
    """A picture to copy from; several are one, beside each other.

    Attributes:
        layout: Where several lie.
        image: Its pixels.
        usable: Which of them may be copied, (height, width); at least one.
        space: How pictures are compared with it.
        features: Of the image, (height, width, channels).
    """

    layout: SideBySide
    image: Image
    usable: Mask
    space: FeatureSpace
    features: Bytes

    @classmethod
    def of(cls, inputs: Mapping[str, Image]) -> Exemplar:
        """Take `exemplar` and `more_exemplars`, and heed an `exemplar_mask` of each.

        Raises:
            RenderError: Not one pixel of one of them may be copied.
        """
        layout = SideBySide.of(inputs)
        allowed = [
            _allowed(inputs, prefix, index + 1) for index, prefix in enumerate(layout.prefixes)
        ]
        image = layout.joined(inputs, "exemplar") or inputs["exemplar"]
        space = FeatureSpace.of(image)
        return cls(layout, image, layout.joined_masks(allowed), space, space.encode(image))

    def matching(self, other: Image) -> Bytes:
        """Return features of another picture, comparable with these."""
        return with_channels(self.space.encode(other), self.features.shape[2])

    @property
    def shape(self) -> tuple[int, int]:
        """Height and width."""
        return self.image.height, self.image.width

    @property
    def smallest(self) -> tuple[float, float]:
        """How much of height and width the smallest one has, of several."""
        widths, heights = zip(*self.layout.sizes, strict=True)
        return min(heights) / self.image.height, min(widths) / self.image.width


def _allowed(inputs: Mapping[str, Image], prefix: str, number: int) -> Mask:
    """Return which pixels of one exemplar may be copied."""
    allowed = usable(inputs[f"{prefix}exemplar"])
    if (mask := inputs.get(f"{prefix}exemplar_mask")) is not None:
        allowed = allowed & (mask.pixels[..., 0] >= 0.5)
    if not allowed.any():
        which = f"exemplar {number}" if prefix else "the exemplar"
        raise RenderError(
            f"alpha and mask leave no pixel of {which} to copy", code="exemplar_unusable"
        )
    return allowed
