"""A texture moved, turned and repeated."""

from __future__ import annotations

import math
from typing import Annotated, ClassVar, Literal

from pydantic import Field

from api_schemas.base import Angle, Pair
from api_schemas.cost import Cost
from api_schemas.families import TextureSpec
from api_schemas.members import Texture

MOST_SAMPLES = 16
"""Samples per pixel along each side, at most."""

Repeats = Annotated[float, Field(ge=-64, le=64)]


class TransformSpec(TextureSpec):
    """Moves, turns, mirrors and repeats a texture, as the transform of a map does on a surface."""

    source: ClassVar[str] = "Catmull, 1974 (bilinear look-up); box of samples where it shrinks"
    equation: ClassVar[str] = "input(offset + R(rotation) scale (u, v))"

    technique: Literal["transform"]
    input: Texture = Field(description="The texture that is moved; it goes on around its edges.")
    offset: Pair = Field(
        default=[0.0, 0.0], description="Shift of the coordinates in tiles, u then v."
    )
    rotation: Angle = Field(
        default=0.0,
        description="Counter-clockwise turn of the coordinates in radians; only quarters of a "
        "circle leave no seam.",
    )
    scale: Annotated[list[Repeats], Field(min_length=2, max_length=2)] = Field(
        default=[1.0, 1.0],
        description="How many tiles fit where one did, along u and v; negative mirrors, and only "
        "whole numbers leave no seam.",
    )

    def samples(self) -> tuple[int, int]:
        """Return how many samples a pixel has along u and along v."""
        across, up = (max(1, min(MOST_SAMPLES, math.ceil(abs(count)))) for count in self.scale)
        return across, up

    def cost(self, pixels: int) -> Cost:
        """Four texels are blended for each sample."""
        return Cost(pixels * (5e-8 + 4e-8 * math.prod(self.samples())), pixels * 48.0)
