"""The product of two textures."""

from __future__ import annotations

from typing import ClassVar, Literal

from pydantic import Field

from api_schemas.cost import Cost
from api_schemas.families import TextureSpec
from api_schemas.members import Operand, Texture


class MultiplySpec(TextureSpec):
    """Multiplies two textures: a tint, a shadow, a pattern within another."""

    source: ClassVar[str] = "none needed"
    equation: ClassVar[str] = "a b"
    solid: ClassVar[bool] = True
    pointwise: ClassVar[bool] = True

    technique: Literal["multiply"]
    a: Texture = Field(description="What is multiplied.")
    b: Operand = Field(
        description="What it is multiplied by: a texture, or a number for every channel alike."
    )

    def cost(self, pixels: int) -> Cost:
        """Both pictures are read once."""
        return Cost(seconds=pixels * 1e-7, bytes=pixels * 96.0)
