"""What a caller wants of a result beside its likeness to the exemplar."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from api_schemas.by_example import GuidedSpec, KeepingSpec
from worker.synthesis.by_example.features import FeatureSpace, usable, weighed, with_channels

if TYPE_CHECKING:
    from collections.abc import Mapping

    from numpy.typing import NDArray

    from worker.images.image import Image
    from worker.synthesis.by_example.exemplar import Exemplar

    Bytes = NDArray[np.uint8]
    Mask = NDArray[np.bool_]


@dataclass(frozen=True, slots=True)
class Wishes:
    """A picture to follow, and one of which parts stay.

    Attributes:
        guides: Features of exemplar and result that have to agree, weighed; None without a guide.
        share: The weight, 0..1, that is left to the texture beside the guide.
        keep: The picture of which parts stay, if there is one.
        fixed: Which pixels stay, (height, width) of the result.
    """

    guides: tuple[Bytes, Bytes] | None
    share: float
    keep: Image | None
    fixed: Mask

    @classmethod
    def of(cls, spec: KeepingSpec, exemplar: Exemplar, inputs: Mapping[str, Image]) -> Wishes:
        """Read the wishes of a spec, whose pictures are `inputs`."""
        width, height = spec.size
        keep, mask = inputs.get("keep"), inputs.get("keep_mask")
        fixed = np.zeros((height, width), bool)
        if keep is not None:
            fixed = usable(keep) if mask is None else np.asarray(mask.pixels[..., 0] >= 0.5)
        if not isinstance(spec, GuidedSpec) or "guide" not in inputs:
            return cls(None, 1.0, keep, fixed)
        ours = exemplar.layout.joined(inputs, "exemplar_guide") or exemplar.image
        space = FeatureSpace.of(ours)
        of_exemplar = space.encode(ours)
        of_result = with_channels(space.encode(inputs["guide"]), of_exemplar.shape[2])
        weight = min(1.0, 2 * spec.guide_weight)
        guides = (weighed(of_exemplar, weight), weighed(of_result, weight))
        return cls(guides, min(1.0, 2 * (1 - spec.guide_weight)), keep, fixed)
