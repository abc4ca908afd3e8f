"""One channel of a picture as data."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from worker.images.image import Image
from worker.synthesis._pointwise import held, wide

if TYPE_CHECKING:
    from collections.abc import Mapping

    from numpy.typing import NDArray

    from api_schemas.textures.pick_channel import PickChannelSpec
    from worker.stages import Report

_LUMINANCE = (0.2126, 0.7152, 0.0722)


def synthesize(
    spec: PickChannelSpec, size: tuple[int, int], inputs: Mapping[str, Image], report: Report
) -> Image:
    """Take a channel of `inputs["input"]`; of colour with alpha, of its straight colour."""
    image = inputs["input"]
    numbers = _red_green_blue_alpha(image)
    if spec.channel == "luminance":
        picked = numbers[..., :3] @ np.array(_LUMINANCE)
    else:
        picked = numbers[..., "rgba".index(spec.channel)]
    return Image(held(picked[..., np.newaxis]), spec.meaning)


def _red_green_blue_alpha(image: Image) -> NDArray[np.float64]:
    numbers = wide(image.pixels)
    full = np.zeros((image.height, image.width, 4))
    full[..., 3] = 1
    own = image.channels - image.has_alpha
    if own == 1:
        full[..., :3] = numbers[..., :1]
    else:
        full[..., :own] = numbers[..., :own]
    if image.has_alpha:
        alpha = numbers[..., -1:]
        full[..., 3:] = alpha
        full[..., :3] = np.divide(
            full[..., :3], alpha, out=np.zeros_like(full[..., :3]), where=alpha > 0
        )
    return full
