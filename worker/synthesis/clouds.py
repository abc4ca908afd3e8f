"""A composition with a name: see its spec."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Mapping

    from api_schemas.textures.clouds import CloudsSpec
    from worker.images.image import Image
    from worker.stages import Report


def synthesize(
    spec: CloudsSpec, size: tuple[int, int], inputs: Mapping[str, Image], report: Report
) -> Image:
    """Return the picture of what it is composed of."""
    return inputs["composed"]
