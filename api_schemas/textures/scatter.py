"""Things placed where there is room for them."""

from __future__ import annotations

from typing import Annotated, ClassVar, Literal

from pydantic import Field

from api_schemas.base import WHOLE, Number, Seed
from api_schemas.cost import Cost
from api_schemas.families import Meaning, TextureSpec
from api_schemas.maps import DATA
from api_schemas.members import Texture

TRIES_MAX = 65536
PLACES_MAX = 4096

Distance = Annotated[float, Field(ge=0, le=0.5)]


class ScatterSpec(TextureSpec):
    """Places discs where a texture reaches a level: trees on hills, pebbles, lichen.

    The picture is 1 where a disc is. The layer `number` tells each disc from the others, counted
    from 1, and `random` has a number from 0 to 1 for each. The report holds the `places`: u, v and
    radius in tiles; and the `share_above` of the texture that reaches the level.
    """

    source: ClassVar[str] = "Gardner, 1985 (vegetation where noise is high); Cook, 1986 (darts)"
    equation: ClassVar[str] = "a try (u, v) stays where density(u, v) >= level and nothing is near"
    meaning: ClassVar[Meaning] = "data"
    layers: ClassVar[tuple[str, ...]] = ("number", "random")

    technique: Literal["scatter"]
    density: Annotated[Texture, DATA] = Field(
        description="The texture whose first channel says where things are."
    )
    level: Number = Field(default=0.5, description="The value from which on they are.")
    tries: Annotated[int, Field(ge=0, le=TRIES_MAX), WHOLE] = Field(
        default=2000,
        description="How many places are tried, anywhere on the tile: more fill it better.",
    )
    most: Annotated[int, Field(ge=1, le=PLACES_MAX), WHOLE] = Field(
        default=1000, description="How many discs there are at most."
    )
    spacing: Distance = Field(
        default=0.02,
        description="How near to another one, middle to middle, none may be, in tiles.",
    )
    radius: Annotated[list[Distance], Field(min_length=2, max_length=2)] = Field(
        default=[0.005, 0.01],
        description="Radius of the smallest and of the largest disc, in tiles.",
    )
    seed: Seed = Field(default=0, description="Another number, other places.")

    def cost(self, pixels: int) -> Cost:
        """Every try looks at its neighbours, every disc fills its pixels."""
        discs = min(self.tries, self.most) * min(1.0, 4 * max(self.radius) ** 2) * pixels
        return Cost(seconds=self.tries * 2e-6 + discs * 4e-9 + pixels * 1e-7, bytes=pixels * 48.0)
