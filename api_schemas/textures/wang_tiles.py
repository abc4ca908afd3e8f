"""A large surface of a few square pieces of an exemplar."""

from __future__ import annotations

from typing import Annotated, ClassVar, Literal

from pydantic import Field

from api_schemas.base import WHOLE, Seed
from api_schemas.cost import Cost
from api_schemas.families import TextureSpec
from api_schemas.members import Texture

TRIES = 24

Side = Annotated[int, Field(ge=16, le=1024), WHOLE]
Half = Annotated[int, Field(ge=4, le=128), WHOLE]
Count = Annotated[int, Field(ge=1, le=64), WHOLE]


class WangTilesSpec(TextureSpec):
    """Lays sixteen square tiles cut from an exemplar in an order that never repeats.

    Each side of a tile has one of two kinds, and tiles lie side by side where the kinds agree: the
    joints are then pieces of the exemplar. The layer `tile` has the number of each tile, 8 for the
    kind at the top, 4 right, 2 at the bottom, 1 left; the report how many of them are used.
    """

    source: ClassVar[str] = "Wang, 1961; Stam, 1997; Cohen et al., 2003; Efros and Freeman, 2001"
    equation: ClassVar[str] = "right(tile) = left(next tile), bottom(tile) = top(tile below)"
    sized: ClassVar[bool] = True
    layers: ClassVar[tuple[str, ...]] = ("tile",)

    technique: Literal["wang_tiles"]
    input: Texture = Field(description="The exemplar; it goes on around its edges.")
    exemplar_size: Annotated[list[Side], Field(min_length=2, max_length=2)] = Field(
        default=[256, 256], description="Width and height in pixels that the exemplar is made at."
    )
    half_side: Half = Field(
        default=32,
        description="Half the side of a tile in pixels: large enough for what the exemplar shows.",
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
        """Sixteen tiles are cut and laid, then brought to the size asked."""
        tile = 4 * self.half_side**2
        laid = tile * self.tiles[0] * self.tiles[1]
        return Cost(
            seconds=tile * TRIES * 4e-7 + laid * 6e-8 + pixels * 4e-8,
            bytes=laid * 24.0 + pixels * 24.0,
        )
