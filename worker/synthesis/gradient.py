"""A number that grows evenly over the tile."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from worker.images.image import Image

if TYPE_CHECKING:
    from collections.abc import Mapping

    from api_schemas.textures.gradient import GradientSpec
    from worker.stages import Report


def synthesize(
    spec: GradientSpec, size: tuple[int, int], inputs: Mapping[str, Image], report: Report
) -> Image:
    """Return u, v, the distance from the middle or the angle round it: one channel of data."""
    width, height = size
    u = ((np.arange(width) + 0.5) / width)[None, :]
    v = (1 - (np.arange(height) + 0.5) / height)[:, None]
    if spec.along == "u":
        values = np.broadcast_to(u, (height, width))
    elif spec.along == "v":
        values = np.broadcast_to(v, (height, width))
    elif spec.along == "radius":
        values = np.minimum(2 * np.hypot(u - 0.5, v - 0.5), 1)
    else:
        values = np.arctan2(v - 0.5, u - 0.5) / (2 * np.pi) % 1.0
    return Image(np.ascontiguousarray(values[..., np.newaxis], np.float32), spec.meaning)
