"""Speckled stone."""

from typing import Annotated, ClassVar, Literal

from pydantic import Field

from api_schemas.base import WHOLE, Color, Seed
from api_schemas.families import PresetSpec, TextureSpec
from api_schemas.textures.constant import ConstantSpec
from api_schemas.textures.levels import LevelsSpec
from api_schemas.textures.mix import MixSpec
from api_schemas.textures.perlin import PerlinSpec
from api_schemas.textures.ramp import RampSpec, RampStop
from api_schemas.textures.worley import WorleySpec


class GraniteSpec(PresetSpec):
    """Granite: two minerals told apart by Perlin noise, and grains of a third round points."""

    source: ClassVar[str] = "Worley, 1996; Perlin, 1985"
    equation: ClassVar[str] = "mix(ramp(perlin), mica, levels(mix(worley, perlin)))"

    technique: Literal["granite"]
    frequency: Annotated[int, Field(ge=1, le=256), WHOLE] = Field(
        default=24, description="Grains per tile: larger is finer."
    )
    colors: Annotated[list[Color], Field(min_length=3, max_length=3)] = Field(
        default=[[0.015, 0.014, 0.017], [0.3, 0.19, 0.15], [0.62, 0.57, 0.52]],
        description="Linear colours of mica, which lies in dark grains, feldspar and quartz.",
    )
    seed: Seed = Field(default=0, description="Another number, another stone.")

    def composed(self) -> TextureSpec:
        """Return mica over a ramp; of grains, values lie between 0 and 1, most of them below .7."""
        mica, feldspar, quartz = self.colors
        rough = PerlinSpec(
            technique="perlin", frequency=self.frequency, octaves=4, gain=0.8, seed=self.seed
        )
        grains = WorleySpec(
            technique="worley", frequency=self.frequency, points="poisson", seed=self.seed
        )
        uneven = MixSpec(technique="mix", a=grains, b=rough, amount=0.6)
        return MixSpec(
            technique="mix",
            a=RampSpec(
                technique="ramp",
                input=rough,
                stops=[
                    RampStop(position=0.47, color=feldspar),
                    RampStop(position=0.53, color=quartz),
                ],
                interpolation="smooth",
            ),
            b=ConstantSpec(technique="constant", value=mica),
            amount=LevelsSpec(technique="levels", input=uneven, input_range=[0.42, 0.38]),
        )
