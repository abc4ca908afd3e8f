"""A cut between dark and bright."""

from __future__ import annotations

from typing import Annotated, ClassVar, Literal

from pydantic import Field

from api_schemas.base import NonNegative, Number
from api_schemas.cost import Cost
from api_schemas.families import Meaning, TextureSpec
from api_schemas.maps import DATA
from api_schemas.members import Texture


class ThresholdSpec(TextureSpec):
    """Makes a mask: 1 where a texture reaches a level, 0 below."""

    source: ClassVar[str] = "none needed"
    equation: ClassVar[str] = "s^2 (3 - 2 s), s = clamp((input - level) / softness + 1/2, 0, 1)"
    meaning: ClassVar[Meaning] = "data"
    solid: ClassVar[bool] = True
    pointwise: ClassVar[bool] = True

    technique: Literal["threshold"]
    input: Annotated[Texture, DATA] = Field(description="The texture whose first channel decides.")
    level: Number = Field(default=0.5, description="The value from which on the mask is 1.")
    softness: NonNegative = Field(
        default=0.0,
        description="How wide the passage from 0 to 1 is, in values of the input around the "
        "level; 0 is a hard edge.",
    )

    def cost(self, pixels: int) -> Cost:
        """One comparison or one curve for each pixel."""
        return Cost(seconds=pixels * 4e-8, bytes=pixels * 40.0)
