"""Each number from its four bytes: textures as memory (Hughes et al., 2013, section 20.10)."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from worker.images.image import Image
from worker.images.packed_floats import unpacked

if TYPE_CHECKING:
    from collections.abc import Mapping

    from api_schemas.textures.unpack_float import UnpackFloatSpec
    from worker.stages import Report


def synthesize(
    spec: UnpackFloatSpec, size: tuple[int, int], inputs: Mapping[str, Image], report: Report
) -> Image:
    """Unpack `inputs["input"]`: one channel."""
    return Image(unpacked(inputs["input"].pixels)[..., np.newaxis], spec.meaning)
