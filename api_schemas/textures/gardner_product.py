"""Gardner's own form: one sum of waves times another."""

from typing import Annotated, ClassVar, Literal

from pydantic import Field

from api_schemas.base import WHOLE, Seed
from api_schemas.cost import Cost
from api_schemas.families import Meaning, TextureSpec


class GardnerProductSpec(TextureSpec):
    """Cumulus clouds, foliage and terrain as Gardner drew them: a product of two sums of waves.

    Each wave is shifted by the next coarser one of the other direction.
    """

    source: ClassVar[str] = "Gardner, 1985"
    equation: ClassVar[str] = (
        "k [sum C_i sin(F_i u + P_i) + T] [sum C_i sin(F_i v + Q_i) + T], F_(i+1) = 2 F_i, "
        "C_(i+1) = gain C_i, P_i = pi/2 sin(F_(i-1) v), Q_i = pi/2 sin(F_(i-1) u)"
    )
    meaning: ClassVar[Meaning] = "data"
    solid: ClassVar[bool] = True

    technique: Literal["gardner_product"]
    frequency: Annotated[int, Field(ge=1, le=256), WHOLE] = Field(
        default=1,
        description="Swings per tile of the longest waves, and so how often the pattern comes.",
    )
    count: Annotated[int, Field(ge=1, le=12), WHOLE] = Field(
        default=6, description="Waves along each direction, each twice as fine as the one before."
    )
    gain: Annotated[float, Field(ge=0, le=1)] = Field(
        default=0.707, description="How much of its strength each wave keeps: larger is rougher."
    )
    contrast: Annotated[float, Field(ge=0, le=1)] = Field(
        default=0.7,
        description="How strong the waves are against the constant they are added to: 0 is flat, "
        "1 goes down to black.",
    )
    seed: Seed = Field(default=0, description="Another number, other phases of the longest waves.")

    def cost(self, pixels: int) -> Cost:
        """Two or three sines for each wave."""
        return Cost(seconds=pixels * 1.2e-7 * self.count, bytes=pixels * 8.0)
