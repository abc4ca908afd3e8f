"""The lesser of two textures."""

from __future__ import annotations

from typing import ClassVar, Literal

from pydantic import Field

from api_schemas.cost import Cost
from api_schemas.families import TextureSpec
from api_schemas.members import Operand, Texture


class MinimumSpec(TextureSpec):
    """Takes the darker of two textures at each point: cracks, gaps, layers from below."""

    source: ClassVar[str] = "none needed"
    equation: ClassVar[str] = "min(a, b), each channel on its own"
    solid: ClassVar[bool] = True
    pointwise: ClassVar[bool] = True

    technique: Literal["minimum"]
    a: Texture = Field(description="The one texture.")
    b: Operand = Field(description="The other one: a texture, or a number no channel goes above.")

    def cost(self, pixels: int) -> Cost:
        """Both pictures are read once."""
        return Cost(seconds=pixels * 1e-7, bytes=pixels * 96.0)
