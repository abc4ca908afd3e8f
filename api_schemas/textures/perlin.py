"""Gradient noise, summed over octaves."""

from typing import Annotated, ClassVar, Literal

from pydantic import Field

from api_schemas.base import WHOLE, Seed
from api_schemas.cost import Cost
from api_schemas.families import Meaning, TextureSpec


class PerlinSpec(TextureSpec):
    """Tileable gradient noise in pictures, solids and time: one smooth octave to rugged sums."""

    source: ClassVar[str] = "Perlin, 1985; Perlin, 2002; Musgrave, 1994 (multifractals)"
    equation: ClassVar[str] = (
        "n_o = noise(frequency lacunarity^o (u, v, w), beats lacunarity^o t), g_o = gain^o; "
        "fbm: sum g_o n_o / sum g_o; turbulence: sum g_o |n_o| / sum g_o; billow: 2 turbulence - 1;"
        " ridged: sum g_o c_o / sum g_o, c_o = (1 - |n_o|)^2 min(1, 2 c_(o-1)); "
        "multifractal: prod (1 + g_o n_o)"
    )
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
        description="Of pictures: eight unit directions, which leave two thirds of the energy in "
        "one octave, or the z = 0 slice of the solid noise of 2002.",
    )
    sum: Literal["fbm", "turbulence", "billow", "ridged", "multifractal"] = Field(
        default="fbm",
        description="How octaves add up: clouds; the creases and valleys of turbulence, of values "
        "from 0; the same around 0; sharp crests, rough only near the crests; or heights that are "
        "rougher the higher they are.",
    )
    depth: Annotated[float, Field(ge=-1024, le=1024)] | None = Field(
        default=None,
        description="How deep in the solid the picture is cut, in tiles, 0 to 1; without it a "
        "picture has the gradients named above. A solid has no such place.",
    )
    time: Annotated[float, Field(ge=-1024, le=1024)] | None = Field(
        default=None,
        description="The moment of a noise that changes, 0 to 1, and at 1 is what it was at 0.",
    )
    beats: Annotated[int, Field(ge=1, le=4096), WHOLE] = Field(
        default=4, description="How often it changes from time 0 to 1."
    )
    output: Literal["value", "slope"] = Field(
        default="value",
        description="The noise, or exactly how fast it rises per tile: along u, v and, of a solid, "
        "w, as two or three channels.",
    )
    range: Literal["unit", "signed"] = Field(
        default="unit",
        description="Values brought into 0..1, with a sum of octaves around 0.5, or as the "
        "formula gives them.",
    )

    def has_formula(self) -> bool:
        """Not for slopes."""
        return self.output != "slope"

    def cost(self, pixels: int) -> Cost:
        """Each octave passes over every pixel once, more often where it is not just added."""
        if self.output == "slope":
            return Cost(seconds=pixels * 4e-7 * self.octaves, bytes=pixels * 96.0)
        passes = 1 if self.sum == "fbm" else 2
        return Cost(seconds=pixels * 1e-8 * self.octaves * passes, bytes=pixels * 16.0 * passes)
