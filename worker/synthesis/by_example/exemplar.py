"""What is copied from: a picture, which of its pixels may be copied, and how it is compared."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from worker.errors import RenderError
from worker.synthesis.by_example.features import FeatureSpace, usable, with_channels

if TYPE_CHECKING:
    from collections.abc import Mapping

    import numpy as np
    from numpy.typing import NDArray

    from worker.images.image import Image

    Bytes = NDArray[np.uint8]
    Mask = NDArray[np.bool_]


@dataclass(frozen=True, slots=True)
class Exemplar:
    """A picture to copy from.

    Attributes:
        image: Its pixels.
        usable: Which of them may be copied, (height, width); at least one.
        space: How pictures are compared with it.
        features: Of the image, (height, width, channels).
    """

    image: Image
    usable: Mask
    space: FeatureSpace
    features: Bytes

    @classmethod
    def of(cls, inputs: Mapping[str, Image]) -> Exemplar:
        """Take `exemplar`, and heed `exemplar_mask` if there is one.

        Raises:
            RenderError: Not one pixel may be copied.
        """
        image = inputs["exemplar"]
        allowed = usable(image)
        if "exemplar_mask" in inputs:
            allowed = allowed & (inputs["exemplar_mask"].pixels[..., 0] >= 0.5)
        if not allowed.any():
            raise RenderError(
                "alpha and mask leave no pixel of the exemplar to copy", code="exemplar_unusable"
            )
        space = FeatureSpace.of(image)
        return cls(image, allowed, space, space.encode(image))

    def matching(self, other: Image) -> Bytes:
        """Return features of another picture, comparable with these."""
        return with_channels(self.space.encode(other), self.features.shape[2])

    @property
    def shape(self) -> tuple[int, int]:
        """Height and width."""
        return self.image.height, self.image.width
