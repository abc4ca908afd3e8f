"""Clouds before a sky."""

from typing import Annotated, ClassVar, Literal

from pydantic import Field

from api_schemas.base import WHOLE, Color, Seed
from api_schemas.families import PresetSpec, TextureSpec
from api_schemas.textures.perlin import PerlinSpec
from api_schemas.textures.ramp import RampSpec, RampStop


class CloudsSpec(PresetSpec):
    """Clouds before a sky: a ramp over a sum of octaves of Perlin noise."""

    source: ClassVar[str] = "Perlin, 1985; Gardner, 1985"
    equation: ClassVar[str] = "ramp(perlin), from sky to cloud around 1 - coverage"

    technique: Literal["clouds"]
    frequency: Annotated[int, Field(ge=1, le=64), WHOLE] = Field(
        default=3, description="Clouds per tile: larger is finer."
    )
    coverage: Annotated[float, Field(ge=0, le=1)] = Field(
        default=0.5, description="How much of the sky is clouded: 0 is clear, 1 is grey."
    )
    softness: Annotated[float, Field(ge=0, le=1)] = Field(
        default=0.4, description="How gently clouds end: 0 cuts them out."
    )
    sky: Color = Field(default=[0.1, 0.25, 0.6], description="Linear colour between clouds.")
    cloud: Color = Field(default=[0.9, 0.9, 0.9], description="Linear colour of dense cloud.")
    seed: Seed = Field(default=0, description="Another number, other clouds.")

    def composed(self) -> TextureSpec:
        """Return the ramp; octaves of noise lie between .3 and .7 nearly everywhere."""
        edge = 0.7 - 0.4 * self.coverage
        half = 0.25 * self.softness
        return RampSpec(
            technique="ramp",
            input=PerlinSpec(
                technique="perlin", frequency=self.frequency, octaves=7, seed=self.seed
            ),
            stops=[
                RampStop(position=edge - half, color=self.sky),
                RampStop(position=edge + half, color=self.cloud),
            ],
            interpolation="smooth",
        )
