"""Noise with a frequency and a direction."""

import math
from typing import Annotated, ClassVar, Literal

from pydantic import Field

from api_schemas.base import WHOLE, Angle, Seed
from api_schemas.cost import Cost
from api_schemas.families import Meaning, TextureSpec


class GaborSpec(TextureSpec):
    """Weave, ripples, brushed metal, fur: little wave packets strewn over the tile."""

    source: ClassVar[str] = "Lagae, Lefebvre, Drettakis and Dutre, 2009"
    equation: ClassVar[str] = (
        "sum_i w_i g(p - p_i), g = exp(-pi a^2 r^2) cos(2 pi F (x cos o + y sin o)), a = bandwidth,"
        " divided by the root of its variance, density (1 + exp(-2 pi F^2 / a^2)) / (4 a^2); in "
        "space (x, y, z).d in the place of x cos o + y sin o, and 2^2.5 a^3 in that of 4 a^2"
    )
    meaning: ClassVar[Meaning] = "data"
    solid: ClassVar[bool] = True

    technique: Literal["gabor"]
    frequency: Annotated[float, Field(ge=0, le=1024)] = Field(
        default=24.0, description="Waves per tile: larger is finer."
    )
    bandwidth: Annotated[float, Field(ge=1, le=512)] = Field(
        default=8.0,
        description="One over the size of a packet in tiles: small is regular, large is wild.",
    )
    orientation: Angle = Field(
        default=0.0, description="Which way the waves run, counter-clockwise from u, in radians."
    )
    spread: Annotated[float, Field(ge=0, le=math.pi)] = Field(
        default=0.0,
        description="How far single packets turn from it at most, in space to all sides: 0 is all "
        "in a row, 3.1416 is the same in all directions.",
    )
    impulses: Annotated[int, Field(ge=1, le=256), WHOLE] = Field(
        default=24, description="Packets that overlap at a point: more is more even."
    )
    range: Literal["unit", "signed"] = Field(
        default="unit",
        description="Four standard deviations reach from 0.5 to 1, or from 0 to 1.",
    )
    seed: Seed = Field(default=0, description="Another number, other places.")

    def cost(self, pixels: int) -> Cost:
        """Every packet is added to the pixels it covers; some are so small they cover none."""
        packets = self.impulses * self.bandwidth**2 / 6.9
        return Cost(
            seconds=pixels * 4e-9 * self.impulses + packets * 2e-6,
            bytes=pixels * 8.0 + packets * 96.0,
        )

    def volume_cost(self, voxels: int) -> Cost:
        """The same in space, where a packet's box holds more of what is beyond its reach."""
        packets = self.impulses * self.bandwidth**3 / 13.6
        return Cost(
            seconds=voxels * 8e-9 * self.impulses + packets * 2e-5,
            bytes=voxels * 12.0 + packets * 160.0,
        )
