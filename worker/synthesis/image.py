"""An uploaded picture."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from worker.images.image import Image
from worker.synthesis._resample import resample

if TYPE_CHECKING:
    from collections.abc import Mapping

    from api_schemas.textures.image import ImageSpec
    from worker.stages import Report


def synthesize(
    spec: ImageSpec, size: tuple[int, int], inputs: Mapping[str, Image], report: Report
) -> Image:
    """Bring `inputs["asset"]` to (width, height); at its own size it stays as it is.

    Where it shrinks a pixel is the mean over its area, where it grows texels blend linearly, and
    the tile goes on around its edges.
    """
    asset = inputs["asset"]
    return Image(resample(asset.pixels, size), asset.meaning)


def warm() -> None:
    """Compile the kernels."""
    resample(np.zeros((2, 2, 1), np.float32), (1, 3))
