"""The same value at every point."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from api_schemas.base import FLOAT32_MAX
from worker.images.image import Image

if TYPE_CHECKING:
    from collections.abc import Mapping

    from numpy.typing import NDArray

    from api_schemas.textures.constant import ConstantSpec
    from worker.closed_form import Parameter
    from worker.stages import Report

LARGEST = np.float32(FLOAT32_MAX)


def synthesize(
    spec: ConstantSpec, size: tuple[int, int], inputs: Mapping[str, Image], report: Report
) -> Image:
    """Fill (width, height) with a colour of 1 to 4 channels; straight alpha is multiplied in."""
    texel = _texel(spec)
    width, height = size
    return Image(np.full((height, width, len(texel)), texel, np.float32), spec.meaning)


def closed_form(spec: ConstantSpec, *, solid: bool) -> Mapping[str, Parameter]:
    """Return the colour with four channels, premultiplied."""
    texel = _texel(spec)
    alpha = texel[-1] if len(texel) in (2, 4) else np.float32(1)
    hues = texel[:3] if len(texel) > 2 else np.repeat(texel[0], 3)
    return {"value": np.append(hues, alpha)}


def _texel(spec: ConstantSpec) -> NDArray[np.float32]:
    value = spec.value if isinstance(spec.value, list) else [spec.value]
    texel = np.array(value, np.float32)
    if len(value) in (2, 4):
        with np.errstate(over="ignore"):
            texel[:-1] *= texel[-1]
    return texel.clip(-LARGEST, LARGEST)  # the product of two numbers may be none
