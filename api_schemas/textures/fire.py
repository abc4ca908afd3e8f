"""Flames."""

from typing import Annotated, ClassVar, Literal

from pydantic import Field

from api_schemas.base import WHOLE, Seed
from api_schemas.families import PresetSpec, TextureSpec
from api_schemas.textures.marble import MarbleSpec
from api_schemas.textures.perlin import PerlinSpec
from api_schemas.textures.ramp import RampSpec, RampStop

_HEAT = (
    (0.0, [0.0, 0.0, 0.0]),
    (0.3, [0.08, 0.0, 0.0]),
    (0.55, [0.9, 0.08, 0.0]),
    (0.8, [1.6, 0.55, 0.03]),
    (1.0, [2.4, 1.9, 0.7]),
)
"""From smoke to white heat, brighter than white at the end."""


class FireSpec(PresetSpec):
    """Flames: a ramp of heat over waves that turbulence tears upwards, as marble is made."""

    source: ClassVar[str] = "Perlin, 1985"
    equation: ClassVar[str] = "ramp(marble(veins up, turbulence))"

    technique: Literal["fire"]
    frequency: Annotated[int, Field(ge=1, le=64), WHOLE] = Field(
        default=4, description="Tongues per tile: larger is finer."
    )
    violence: Annotated[float, Field(ge=0, le=64)] = Field(
        default=9.0, description="How far turbulence tears the flames, in radians of their wave."
    )
    time: Annotated[float, Field(ge=-1024, le=1024)] = Field(
        default=0.0, description="The moment, 0 to 1, and at 1 it burns as at 0."
    )
    seed: Seed = Field(default=0, description="Another number, another fire.")

    def composed(self) -> TextureSpec:
        """Return the ramp."""
        return RampSpec(
            technique="ramp",
            input=MarbleSpec(
                technique="marble",
                veins=[0, 1],
                strength=self.violence,
                turbulence=PerlinSpec(
                    technique="perlin",
                    frequency=self.frequency,
                    octaves=6,
                    sum="turbulence",
                    time=self.time,
                    seed=self.seed,
                ),
            ),
            stops=[RampStop(position=position, color=color) for position, color in _HEAT],
            interpolation="smooth",
        )
