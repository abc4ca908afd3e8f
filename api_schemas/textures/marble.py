"""Veins that another texture disturbs."""

from __future__ import annotations

from typing import Annotated, ClassVar, Literal

from pydantic import Field

from api_schemas.base import WHOLE, Number
from api_schemas.cost import Cost
from api_schemas.families import Meaning, TextureSpec
from api_schemas.maps import DATA
from api_schemas.members import Texture

Veins = Annotated[int, Field(ge=-256, le=256), WHOLE]


class MarbleSpec(TextureSpec):
    """Veins of marble, curls of smoke: waves bent by turbulence; a ramp gives them colours."""

    source: ClassVar[str] = "Perlin, 1985"
    equation: ClassVar[str] = "sin(2 pi veins . (u, v, w) + strength turbulence)"
    meaning: ClassVar[Meaning] = "data"
    solid: ClassVar[bool] = True

    technique: Literal["marble"]
    veins: Annotated[list[Veins], Field(min_length=2, max_length=3)] = Field(
        default=[3, 0],
        description="How many veins cross the tile along u, v and, in a solid, w; whole, so the "
        "tile repeats.",
    )
    turbulence: Annotated[Texture, DATA] = Field(
        default={"technique": "perlin", "frequency": 3, "octaves": 6, "sum": "turbulence"},
        validate_default=True,
        description="What bends the veins: its first channel.",
    )
    strength: Annotated[float, Field(ge=-1000, le=1000)] = Field(
        default=12.0,
        description="Angle by which a value of 1 moves along the wave, in radians: 0 leaves "
        "straight stripes, 6.28 is a whole vein.",
    )
    rest: Number = Field(
        default=0.0, description="The value of the turbulence that leaves a vein in place."
    )
    range: Literal["unit", "signed"] = Field(
        default="unit", description="Values within 0..1, or within -1..1."
    )

    def has_formula(self) -> bool:
        """Always."""
        return True

    def cost(self, pixels: int) -> Cost:
        """A sine for every pixel."""
        return Cost(seconds=pixels * 4e-8, bytes=pixels * 16.0)
