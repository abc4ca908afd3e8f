"""The greater of two textures at each point."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from worker.synthesis._pointwise import combined, operand

if TYPE_CHECKING:
    from collections.abc import Mapping

    from api_schemas.textures.maximum import MaximumSpec
    from worker.images.image import Image
    from worker.stages import Report


def synthesize(
    spec: MaximumSpec, size: tuple[int, int], inputs: Mapping[str, Image], report: Report
) -> Image:
    """Take the greater of `inputs["a"]` and b, each channel on its own."""
    return combined(inputs["a"], operand(inputs, "b", spec.b), lambda a, b: np.maximum(a, b))
