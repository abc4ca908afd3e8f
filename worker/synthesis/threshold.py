"""A mask: where a texture reaches a level, with a hard or a soft edge."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from worker.images.image import Image
from worker.synthesis._pointwise import wide

if TYPE_CHECKING:
    from collections.abc import Mapping

    from api_schemas.textures.threshold import ThresholdSpec
    from worker.stages import Report


def synthesize(
    spec: ThresholdSpec, size: tuple[int, int], inputs: Mapping[str, Image], report: Report
) -> Image:
    """Cut the first channel of `inputs["input"]` at the level: one channel of data."""
    values = wide(inputs["input"].pixels[..., :1])
    if spec.softness == 0:
        return Image((values >= spec.level).astype(np.float32), spec.meaning)
    with np.errstate(over="ignore"):
        share = np.clip((values - spec.level) / spec.softness + 0.5, 0, 1)
    return Image((share * share * (3 - 2 * share)).astype(np.float32), spec.meaning)
