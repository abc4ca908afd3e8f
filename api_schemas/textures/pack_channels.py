"""Channels put side by side."""

from __future__ import annotations

from typing import Annotated, ClassVar, Literal

from pydantic import Field

from api_schemas.cost import Cost
from api_schemas.families import Meaning, TextureSpec
from api_schemas.maps import DATA
from api_schemas.members import Operand


class PackChannelsSpec(TextureSpec):
    """Puts textures into the channels of one, as glTF wants occlusion, roughness and metal."""

    source: ClassVar[str] = "none needed"
    equation: ClassVar[str] = "(r, g, b, a), the first channel of each"
    meaning: ClassVar[Meaning] = "data"
    solid: ClassVar[bool] = True
    pointwise: ClassVar[bool] = True

    technique: Literal["pack_channels"]
    r: Annotated[Operand, DATA] = Field(
        default=0.0, description="The red channel: the first channel of a texture, or a number."
    )
    g: Annotated[Operand, DATA] = Field(default=0.0, description="The green channel, likewise.")
    b: Annotated[Operand, DATA] = Field(default=0.0, description="The blue channel, likewise.")
    a: Annotated[Operand | None, DATA] = Field(
        default=None, description="A fourth channel, likewise; without one there are three."
    )

    def cost(self, pixels: int) -> Cost:
        """Up to four pictures are read once."""
        return Cost(seconds=pixels * 5e-8, bytes=pixels * 48.0)
