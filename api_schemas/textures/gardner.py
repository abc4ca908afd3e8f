"""A few waves, added."""

from typing import Annotated, ClassVar, Literal

from pydantic import Field

from api_schemas.base import WHOLE, Angle, Schema, Seed
from api_schemas.cost import Cost
from api_schemas.families import Meaning, TextureSpec

Cycles = Annotated[int, Field(ge=-1024, le=1024), WHOLE]


class Wave(Schema):
    """One wave across the tile."""

    cycles: Annotated[list[Cycles], Field(min_length=2, max_length=3)] = Field(
        description="How often it swings per tile along u, v and, in a solid, w; whole, so the "
        "tile repeats."
    )
    phase: Angle = Field(
        default=0.0, description="Angle of the cosine at the lower left corner, in radians."
    )


class GardnerSpec(TextureSpec):
    """Rolling hills, ripples and soft clouds from a few cosine waves; tiles without a seam."""

    source: ClassVar[str] = "Gardner, 1985"
    equation: ClassVar[str] = (
        "(1/n) sum_i cos(2 pi (a_i u + b_i v [+ c_i w]) + d_i), "
        "frequency <= |(a_i, b_i[, c_i])| <= frequency + bandwidth"
    )
    meaning: ClassVar[Meaning] = "data"
    solid: ClassVar[bool] = True

    technique: Literal["gardner"]
    frequency: Annotated[int, Field(ge=1, le=512), WHOLE] = Field(
        default=3, description="Swings per tile of the longest waves: larger is finer."
    )
    bandwidth: Annotated[int, Field(ge=0, le=512), WHOLE] = Field(
        default=5,
        description="How many more swings the shortest waves have: 0 is regular, more is wilder.",
    )
    count: Annotated[int, Field(ge=1, le=256), WHOLE] = Field(
        default=6, description="How many waves are added: few are ripples, many are clouds."
    )
    seed: Seed = Field(default=0, description="Another number, other directions and phases.")
    waves: Annotated[list[Wave], Field(max_length=256)] = Field(
        default=[],
        description="The waves themselves; when there are any, frequency, bandwidth, count and "
        "seed are not used.",
    )
    range: Literal["unit", "signed"] = Field(
        default="unit", description="Values around 0.5 within 0..1, or around 0 within -1..1."
    )

    def has_formula(self) -> bool:
        """Always."""
        return True

    def cost(self, pixels: int) -> Cost:
        """One matrix product, twice as deep as there are waves, after a search for the waves."""
        waves = len(self.waves) or self.count
        candidates = 0 if self.waves else 2 * (self.frequency + self.bandwidth) ** 2
        return Cost(
            seconds=pixels * (5e-9 + 5e-10 * waves) + candidates * 2e-7,
            bytes=pixels * (4.0 + waves / 8) + candidates * 64.0,
        )

    def volume_cost(self, voxels: int) -> Cost:
        """The same product for each slice, after a search among the waves of space."""
        cost = self.cost(voxels)
        candidates = 0 if self.waves else 4 * (self.frequency + self.bandwidth) ** 3
        return Cost(cost.seconds + candidates * 2e-7, cost.bytes + candidates * 96.0)
