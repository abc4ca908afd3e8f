"""Each number as four bytes: textures as memory (Hughes et al., 2013, section 20.10)."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from worker.images.image import Image
from worker.images.packed_floats import packed

if TYPE_CHECKING:
    from collections.abc import Mapping

    from api_schemas.textures.pack_float import PackFloatSpec
    from worker.stages import Report


def synthesize(
    spec: PackFloatSpec, size: tuple[int, int], inputs: Mapping[str, Image], report: Report
) -> Image:
    """Pack one channel of `inputs["input"]`: a grey has three alike, a missing alpha is 1."""
    image = inputs["input"]
    channel = "rgba".index(spec.channel)
    channel = 0 if image.channels == 1 and channel < 3 else channel
    numbers = (
        image.pixels[..., channel]
        if channel < image.channels
        else np.full(image.pixels.shape[:2], float(channel == 3), np.float32)
    )
    return Image(packed(numbers), spec.meaning)
