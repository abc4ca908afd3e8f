"""Colours along a line, picked by another texture."""

from __future__ import annotations

from typing import Annotated, ClassVar, Literal

from pydantic import Field

from api_schemas.base import Color, Number, Schema
from api_schemas.families import TextureSpec
from api_schemas.maps import DATA
from api_schemas.members import Texture


class RampStop(Schema):
    """One colour and the value of the input at which it is reached."""

    position: Number = Field(description="Value of the input where this colour is pure.")
    color: Color = Field(description="Linear colour.")


class RampSpec(TextureSpec):
    """Turns a scalar into colours: the input's first channel picks a place between the stops."""

    source: ClassVar[str] = "Perlin, 1985 (colour splines)"
    equation: ClassVar[str] = "color(input(u, v))"
    solid: ClassVar[bool] = True
    pointwise: ClassVar[bool] = True

    technique: Literal["ramp"]
    input: Annotated[Texture, DATA] = Field(
        description="The texture whose first channel picks the colour."
    )
    stops: Annotated[list[RampStop], Field(min_length=1, max_length=64)] = Field(
        description="Colours by position, in any order; beyond the ends the end colours go on, "
        "and two stops at one position make a hard edge."
    )
    interpolation: Literal["linear", "smooth", "step"] = Field(
        default="linear", description="Straight blends, blends with soft ends, or flat bands."
    )

    def has_formula(self) -> bool:
        """Always."""
        return True
