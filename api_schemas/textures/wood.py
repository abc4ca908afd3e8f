"""Year rings that another texture disturbs."""

from __future__ import annotations

from typing import Annotated, ClassVar, Literal

from pydantic import Field

from api_schemas.base import Number
from api_schemas.cost import Cost
from api_schemas.families import Meaning, TextureSpec
from api_schemas.maps import DATA
from api_schemas.members import Texture

Middle = Annotated[float, Field(ge=-16, le=16)]


class WoodSpec(TextureSpec):
    """Year rings of a trunk; a ramp gives them colours.

    Each ring rises from 0 to 1 and falls back at once. A picture is a cut: across the trunk, or
    along it beside its heart.
    """

    source: ClassVar[str] = "Peachey, 1985; Perlin, 1985"
    equation: ClassVar[str] = "frac(rings sqrt(x^2 + y^2) + strength (noise - rest))"
    meaning: ClassVar[Meaning] = "data"
    solid: ClassVar[bool] = True

    technique: Literal["wood"]
    rings: Annotated[float, Field(ge=0, le=256)] = Field(
        default=12.0, description="Rings per tile, from the heart outwards."
    )
    trunk: Literal["u", "v", "w"] = Field(
        default="w", description="Which way the trunk grows; w is into the picture."
    )
    heart: Annotated[list[Middle], Field(min_length=2, max_length=2)] = Field(
        default=[0.5, 0.5],
        description="Where the heart is, in tiles, along the two axes across the trunk in the "
        "order u, v, w. A picture lies at w = 0.",
    )
    noise: Annotated[Texture, DATA] = Field(
        default={"technique": "perlin", "frequency": 3, "octaves": 3},
        validate_default=True,
        description="What makes the rings uneven: its first channel.",
    )
    strength: Annotated[float, Field(ge=-1000, le=1000)] = Field(
        default=3.0, description="Rings by which a value of 1 moves outwards or inwards."
    )
    rest: Number = Field(
        default=0.5, description="The value of the noise that leaves a ring in place."
    )

    def has_formula(self) -> bool:
        """Always."""
        return True

    def cost(self, pixels: int) -> Cost:
        """A root for every pixel."""
        return Cost(seconds=pixels * 4e-8, bytes=pixels * 16.0)
