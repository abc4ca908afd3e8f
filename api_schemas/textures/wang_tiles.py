"""A large surface of a few square pieces of an exemplar."""

from __future__ import annotations

import math
from typing import Annotated, ClassVar, Literal

from pydantic import Field

from api_schemas.base import WHOLE, Seed
from api_schemas.cost import Cost
from api_schemas.families import TextureSpec
from api_schemas.members import Texture

Side = Annotated[int, Field(ge=16, le=1024), WHOLE]
Half = Annotated[int, Field(ge=4, le=128), WHOLE]
Count = Annotated[int, Field(ge=1, le=64), WHOLE]
Kinds = Annotated[int, Field(ge=2, le=4), WHOLE]
Variants = Annotated[int, Field(ge=1, le=8), WHOLE]


class WangTilesSpec(TextureSpec):
    """Lays square tiles cut from an exemplar in an order that never repeats.

    Each corner of a tile has a kind, and tiles lie side by side where the kinds agree: the joints
    are then pieces of the exemplar. The layer `tile` has the number of each tile: the kinds of its
    corners, clockwise from the upper left one, as digits to the base `kinds`; that times
    `variants`, and which of these it is. The report says how many tiles are used.
    """

    revision: ClassVar[int] = 2
    source: ClassVar[str] = (
        "Wang, 1961; Stam, 1997; Cohen et al., 2003; Kwatra et al., 2003; Lagae and Dutre, 2006"
    )
    equation: ClassVar[str] = "right(tile) = left(next tile), bottom(tile) = top(tile below)"
    sized: ClassVar[bool] = True
    layers: ClassVar[tuple[str, ...]] = ("source", "tile")

    technique: Literal["wang_tiles"]
    input: Texture = Field(description="The exemplar; it goes on around its edges.")
    exemplar_size: Annotated[list[Side], Field(min_length=2, max_length=2)] = Field(
        default=[256, 256], description="Width and height in pixels that the exemplar is made at."
    )
    half_side: Half = Field(
        default=32,
        description="Half the side of a tile in pixels: large enough for what the exemplar shows.",
    )
    kinds: Kinds = Field(
        default=3,
        description="How many kinds of corners there are: more let what lies at corners and edges "
        "come back less often, and leave less choice for each.",
    )
    variants: Variants = Field(
        default=1,
        description="How many tiles have the same four corners: more let what lies in the middle "
        "come back less often.",
    )
    tiles: Annotated[list[Count], Field(min_length=2, max_length=2)] = Field(
        default=[8, 8], description="How many tiles lie beside each other, along u and v."
    )
    seed: Seed = Field(default=0, description="Another number, other pieces in another order.")

    @property
    def size(self) -> list[int]:
        """Width and height of all tiles together in pixels."""
        return [2 * self.half_side * count for count in self.tiles]

    def inner_size(self, size: tuple[int, int]) -> tuple[int, int]:
        """The exemplar has a size of its own."""
        return self.exemplar_size[0], self.exemplar_size[1]

    def cost(self, pixels: int) -> Cost:
        """Corners, edges and tiles are cut as far as they are used, laid, and judged."""
        tile, laid = 4 * self.half_side**2, math.prod(self.size)
        cut = self.kinds + 2 * self.kinds**2
        cut += min(math.prod(self.tiles), self.kinds**4 * self.variants)
        seen = math.prod(max(side, 4 * self.half_side) for side in self.exemplar_size)
        return Cost(
            seconds=cut * (3e-3 + seen * 2e-7 + tile * self.half_side * 2e-7)
            + laid * 3e-6
            + pixels * 5e-8,
            bytes=laid * 160.0 + seen * 240.0 + tile * 800.0 + cut * tile * 8.0 + pixels * 64.0,
        )
