"""The first channels of up to four textures as the channels of one."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from worker.images.image import Image
from worker.synthesis._pointwise import operand

if TYPE_CHECKING:
    from collections.abc import Mapping

    from api_schemas.textures.pack_channels import PackChannelsSpec
    from worker.stages import Report


def synthesize(
    spec: PackChannelsSpec, size: tuple[int, int], inputs: Mapping[str, Image], report: Report
) -> Image:
    """Return three or four channels of data, of pictures by name or the spec's numbers."""
    names = "rgb" if spec.a is None else "rgba"
    width, height = size
    pixels = np.empty((height, width, len(names)), np.float32)
    for index, name in enumerate(names):
        source = operand(inputs, name, getattr(spec, name))
        pixels[..., index] = source.pixels[..., 0] if isinstance(source, Image) else source
    return Image(pixels, spec.meaning)
