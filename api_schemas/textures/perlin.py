"""Gradient noise, summed over octaves."""

from typing import Annotated, ClassVar, Literal

from pydantic import Field

from api_schemas.base import WHOLE, Seed
from api_schemas.cost import Cost
from api_schemas.families import Meaning, TextureSpec


class PerlinSpec(TextureSpec):
    """Tileable gradient noise in two dimensions, from one smooth octave to rugged fractal sums."""

    source: ClassVar[str] = "Perlin, 1985; Perlin, 2002"
    equation: ClassVar[str] = "sum_o gain^o noise(frequency lacunarity^o (u, v)) / sum_o gain^o"
    meaning: ClassVar[Meaning] = "data"
    solid: ClassVar[bool] = True

    technique: Literal["perlin"]
    frequency: Annotated[int, Field(ge=1, le=4096), WHOLE] = Field(
        default=8, description="Bumps per tile: larger is finer."
    )
    octaves: Annotated[int, Field(ge=1, le=16), WHOLE] = Field(
        default=1,
        description="Layers of ever finer detail; those finer than two pixels fade away.",
    )
    lacunarity: Annotated[int, Field(ge=2, le=8), WHOLE] = Field(
        default=2, description="How many times finer each octave is than the one before."
    )
    gain: Annotated[float, Field(ge=0, le=1)] = Field(
        default=0.5, description="How much of its strength each octave keeps: larger is rougher."
    )
    seed: Seed = Field(
        default=0, description="Another number, another pattern; 0 is the reference permutation."
    )
    fade: Literal["quintic", "cubic", "linear"] = Field(
        default="quintic",
        description="How cells blend: without visible creases, as in 1985, or with creases.",
    )
    gradients: Literal["eight", "reference"] = Field(
        default="eight",
        description="Eight unit directions, or the z = 0 slice of the solid noise of 2002.",
    )
    range: Literal["unit", "signed"] = Field(
        default="unit", description="Values around 0.5 within 0..1, or around 0 within -1..1."
    )

    def cost(self, pixels: int) -> Cost:
        """Each octave passes over every pixel once."""
        return Cost(seconds=pixels * 1e-8 * self.octaves, bytes=pixels * 16)
