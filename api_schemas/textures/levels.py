"""A texture's values stretched."""

from __future__ import annotations

from typing import Annotated, ClassVar, Literal

from pydantic import Field

from api_schemas.base import Number
from api_schemas.cost import Cost
from api_schemas.families import TextureSpec
from api_schemas.members import Texture

Interval = Annotated[list[Number], Field(min_length=2, max_length=2)]


class LevelsSpec(TextureSpec):
    """Changes contrast and brightness: takes one range of values to another, along a curve."""

    source: ClassVar[str] = "none needed"
    equation: ClassVar[str] = (
        "out0 + (out1 - out0) ((input - in0) / (in1 - in0))^(1 / gamma), alpha stays"
    )
    solid: ClassVar[bool] = True
    pointwise: ClassVar[bool] = True

    technique: Literal["levels"]
    input: Texture = Field(description="The texture whose values are changed, each channel alike.")
    input_range: Interval = Field(
        default=[0.0, 1.0],
        description="What becomes the ends of the output range; equal numbers cut hard at that "
        "value, the larger one first turns dark and bright around.",
    )
    output_range: Interval = Field(default=[0.0, 1.0], description="Where those values go.")
    gamma: Annotated[float, Field(ge=0.1, le=10)] = Field(
        default=1.0, description="Above 1 brightens the middle, below 1 darkens it."
    )
    clamp: bool = Field(
        default=True,
        description="Whether what lies beyond the input range stops at the ends of the output "
        "range.",
    )

    def has_formula(self) -> bool:
        """Always."""
        return True

    def cost(self, pixels: int) -> Cost:
        """A power for each channel, where there is a gamma."""
        return Cost(seconds=pixels * (1e-7 if self.gamma == 1 else 4e-7), bytes=pixels * 64.0)
