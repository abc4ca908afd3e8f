"""Two chemicals that feed, react and spread."""

from typing import Annotated, ClassVar, Literal

from pydantic import Field

from api_schemas.base import WHOLE, Seed
from api_schemas.cost import Cost
from api_schemas.families import Meaning, TextureSpec

Side = Annotated[int, Field(ge=16, le=2048), WHOLE]


class GrayScottSpec(TextureSpec):
    """Spots, mazes, coral and dividing cells: what two reacting chemicals leave in a dish."""

    source: ClassVar[str] = "Gray and Scott, 1984; Pearson, 1993"
    equation: ClassVar[str] = (
        "du/dt = diffusion_u Lap u - u v^2 + feed (1 - u), "
        "dv/dt = diffusion_v Lap v + u v^2 - (feed + kill) v"
    )
    meaning: ClassVar[Meaning] = "data"
    sized: ClassVar[bool] = True

    technique: Literal["gray_scott"]
    size: Annotated[list[Side], Field(min_length=2, max_length=2)] = Field(
        default=[256, 256],
        description="Width and height of the dish in grid cells: a larger one holds more pattern.",
    )
    steps: Annotated[int, Field(ge=0, le=20000), WHOLE] = Field(
        default=5000, description="For how long the chemicals react: patterns spread and settle."
    )
    feed: Annotated[float, Field(ge=0, le=0.1)] = Field(
        default=0.037,
        description="How fast fresh u flows in: together with kill it picks the pattern.",
    )
    kill: Annotated[float, Field(ge=0, le=0.1)] = Field(
        default=0.06,
        description="How fast v is taken out: less makes mazes and holes, more makes spots, too "
        "much leaves nothing.",
    )
    diffusion_u: Annotated[float, Field(ge=0, le=0.25)] = Field(
        default=0.2097152, description="How fast u spreads, in squared grid cells per step."
    )
    diffusion_v: Annotated[float, Field(ge=0, le=0.2)] = Field(
        default=0.1048576,
        description="How fast v spreads; both together larger or smaller scale the pattern.",
    )
    drops: Annotated[int, Field(ge=1, le=1024), WHOLE] = Field(
        default=16, description="Drops of v that the pattern grows from."
    )
    chemical: Literal["u", "v"] = Field(
        default="v", description="Which chemical is shown: u is near 1 and v near 0 where it rests."
    )
    seed: Seed = Field(default=0, description="Another number, drops in other places.")

    def cost(self, pixels: int) -> Cost:
        """Every step passes over every cell of the dish, then it is brought to the size asked."""
        cells = self.size[0] * self.size[1]
        return Cost(
            seconds=cells * self.steps * 2e-9 + cells * 2e-8 + pixels * 2e-8,
            bytes=cells * 24.0 + pixels * 8.0,
        )
