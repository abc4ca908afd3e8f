"""Noise without clumps."""

from __future__ import annotations

from typing import Annotated, ClassVar, Literal

from pydantic import Field

from api_schemas.base import WHOLE, Seed
from api_schemas.cost import Cost
from api_schemas.families import Meaning, TextureSpec

Side = Annotated[int, Field(ge=16, le=256), WHOLE]


class BlueNoiseSpec(TextureSpec):
    """Every value as often as any other, and like values far apart: for dithering and scattering.

    What is darker than a threshold is evenly scattered, whatever the threshold. The tile is
    repeated pixel by pixel; a picture whose sides are not multiples of its own has a seam.
    """

    source: ClassVar[str] = "Ulichney, 1993 (void and cluster)"
    equation: ClassVar[str] = "value = (rank + 1/2) / side^2"
    meaning: ClassVar[Meaning] = "data"
    sized: ClassVar[bool] = True
    surface_side: ClassVar[int] = 256

    technique: Literal["blue_noise"]
    side: Side = Field(default=64, description="Pixels along each side of the tile.")
    seed: Seed = Field(default=0, description="Another number, another noise.")

    @property
    def size(self) -> list[int]:
        """Width and height of the tile in pixels."""
        return [self.side, self.side]

    def cost(self, pixels: int) -> Cost:
        """Each pixel of the tile is placed once, and looks for its place among the rows."""
        cells = self.side**2
        return Cost(seconds=cells * self.side * 6e-8 + pixels * 1e-8, bytes=cells * 40 + pixels * 8)
