"""The product of two textures."""

from __future__ import annotations

from typing import TYPE_CHECKING

from worker.synthesis._pointwise import combined, operand

if TYPE_CHECKING:
    from collections.abc import Mapping

    from api_schemas.textures.multiply import MultiplySpec
    from worker.images.image import Image
    from worker.stages import Report


def synthesize(
    spec: MultiplySpec, size: tuple[int, int], inputs: Mapping[str, Image], report: Report
) -> Image:
    """Multiply `inputs["a"]` and b, each channel on its own."""
    return combined(inputs["a"], operand(inputs, "b", spec.b), lambda a, b: a * b)
