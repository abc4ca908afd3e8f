"""The sum of two textures."""

from __future__ import annotations

from typing import ClassVar, Literal

from pydantic import Field

from api_schemas.base import Number
from api_schemas.cost import Cost
from api_schemas.families import TextureSpec
from api_schemas.members import Operand, Texture


class AddSpec(TextureSpec):
    """Adds two textures: details on hills, light on light."""

    source: ClassVar[str] = "none needed"
    equation: ClassVar[str] = "a + weight b"
    solid: ClassVar[bool] = True
    pointwise: ClassVar[bool] = True

    technique: Literal["add"]
    a: Texture = Field(description="What is added to.")
    b: Operand = Field(description="What is added: a texture, or a number for every channel alike.")
    weight: Number = Field(
        default=1.0, description="How much of b is added: negative takes it away."
    )

    def cost(self, pixels: int) -> Cost:
        """Both pictures are read once."""
        return Cost(seconds=pixels * 1e-7, bytes=pixels * 96.0)
