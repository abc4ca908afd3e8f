"""Two chemicals that feed, react and spread."""

from __future__ import annotations

from typing import Annotated, ClassVar, Literal

from pydantic import Field

from api_schemas.base import WHOLE
from api_schemas.dishes import DishSpec
from api_schemas.parameters import MappedFeed, MappedFifth, MappedQuarter


class GrayScottSpec(DishSpec):
    """Spots, mazes, coral and dividing cells: what two reacting chemicals leave in a dish."""

    source: ClassVar[str] = "Gray and Scott, 1984; Pearson, 1993"
    equation: ClassVar[str] = (
        "du/dt = diffusion_u Lap u - u v^2 + feed (1 - u), "
        "dv/dt = diffusion_v Lap v + u v^2 - (feed + kill) v"
    )
    layers: ClassVar[tuple[str, ...]] = ("u", "v")
    parameters: ClassVar[tuple[str, ...]] = ("feed", "kill", "diffusion_u", "diffusion_v")
    seconds_per_cell: ClassVar[float] = 2e-9

    technique: Literal["gray_scott"]
    feed: MappedFeed = Field(
        default=0.037,
        description="How fast fresh u flows in: together with kill it picks the pattern.",
    )
    kill: MappedFeed = Field(
        default=0.06,
        description="How fast v is taken out: less makes mazes and holes, more makes spots, too "
        "much leaves nothing.",
    )
    diffusion_u: MappedQuarter = Field(
        default=0.2097152, description="How fast u spreads, in squared grid cells per step."
    )
    diffusion_v: MappedFifth = Field(
        default=0.1048576,
        description="How fast v spreads; both together larger or smaller scale the pattern.",
    )
    drops: Annotated[int, Field(ge=1, le=1024), WHOLE] = Field(
        default=16,
        description="Drops of v that the pattern grows from, where no mask says where v is at "
        "first.",
    )
    chemical: Literal["u", "v"] = Field(
        default="v", description="Which chemical is shown: u is near 1 and v near 0 where it rests."
    )
