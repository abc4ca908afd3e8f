"""Gradient noise along a line."""

from typing import Annotated, ClassVar, Literal

from pydantic import Field

from api_schemas.base import WHOLE, Seed
from api_schemas.cost import Cost
from api_schemas.families import Meaning, TextureSpec

Gradient = Annotated[float, Field(ge=-16, le=16)]
Place = Annotated[float, Field(ge=-1e6, le=1e6)]


class PerlinCurveSpec(TextureSpec):
    """Perlin noise in one dimension: its curve as a picture, or its values from left to right.

    The job's report tells values and slopes at the places asked for.
    """

    source: ClassVar[str] = "Perlin, 1985; Hughes et al., 2013, section 20.8.2"
    equation: ClassVar[str] = (
        "(1 - a(s)) g_i s + a(s) g_(i+1) (s - 1), i = floor x, s = x - i, a the fade"
    )
    meaning: ClassVar[Meaning] = "data"

    technique: Literal["perlin_curve"]
    gradients: Annotated[list[Gradient], Field(max_length=256)] = Field(
        default=[],
        description="The slope at each whole number, from 0 on; after the last comes the first "
        "again. None: as many as `frequency`, drawn from -1, 0 and 1.",
    )
    frequency: Annotated[int, Field(ge=1, le=256), WHOLE] = Field(
        default=20, description="How many slopes are drawn, which is also the period."
    )
    seed: Seed = Field(default=0, description="Another number, other slopes.")
    fade: Literal["quintic", "cubic", "linear"] = Field(
        default="quintic",
        description="How neighbours blend: smooth in slope and curvature, in slope, or with kinks.",
    )
    show: Literal["curve", "values"] = Field(
        default="curve",
        description="A dark line on white, over a period from left to right and from -1 at the "
        "bottom to 1 at the top; or the values themselves as stripes, brought into 0..1.",
    )
    thickness: Annotated[float, Field(ge=0.001, le=0.5)] = Field(
        default=0.01, description="Of the line, as a share of the picture's height."
    )
    at: Annotated[list[Place], Field(max_length=1024)] = Field(
        default=[], description="Where values are told in numbers, in steps from slope to slope."
    )

    def cost(self, pixels: int) -> Cost:
        """Distances to 32 chords for every pixel."""
        return Cost(seconds=pixels * 2e-7, bytes=pixels * 16.0)
