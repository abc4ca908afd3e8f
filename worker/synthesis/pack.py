"""The first channels of up to four textures as the channels of one."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from worker.images.image import Image

if TYPE_CHECKING:
    from collections.abc import Mapping

    from api_schemas.textures.pack import PackSpec


def synthesize(spec: PackSpec, size: tuple[int, int], inputs: Mapping[str, Image]) -> Image:
    """Return three or four channels of data, of pictures by name or the spec's numbers."""
    names = "rgb" if spec.a is None else "rgba"
    width, height = size
    pixels = np.empty((height, width, len(names)), np.float32)
    for index, name in enumerate(names):
        image = inputs.get(name)
        pixels[..., index] = getattr(spec, name) if image is None else image.pixels[..., 0]
    return Image(pixels, spec.meaning)
