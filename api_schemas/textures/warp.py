"""A texture pushed about by another."""

from __future__ import annotations

from typing import Annotated, ClassVar, Literal

from pydantic import Field

from api_schemas.base import Number
from api_schemas.cost import Cost
from api_schemas.families import TextureSpec
from api_schemas.maps import DATA
from api_schemas.members import Texture

Shift = Annotated[float, Field(ge=-16, le=16)]


class WarpSpec(TextureSpec):
    """Bends a texture: turbulent veins, wavy bricks, melted patterns."""

    source: ClassVar[str] = "Perlin, 1985; Catmull, 1974 (bilinear look-up)"
    equation: ClassVar[str] = "input(p + strength (by(p) - rest)), p = (u, v) or (u, v, w)"
    solid: ClassVar[bool] = True

    technique: Literal["warp"]
    input: Texture = Field(description="The texture that is bent; it goes on around its edges.")
    by: Annotated[Texture, DATA] = Field(
        description="Says how far to look away: its first channel along u, its second along v, "
        "of a solid its third along w; the last one it has also along those that have none."
    )
    strength: Annotated[list[Shift], Field(min_length=2, max_length=3)] = Field(
        default=[0.1, 0.1],
        description="Tiles to look away along u and v where `by` is one above `rest`; a third "
        "number is for w of a solid, where without it that of v holds.",
    )
    rest: Number = Field(default=0.5, description="The value of `by` that leaves a point in place.")

    def cost(self, pixels: int) -> Cost:
        """Four texels are blended for each pixel."""
        return Cost(seconds=pixels * 1.2e-7, bytes=pixels * 64.0)

    def volume_cost(self, voxels: int) -> Cost:
        """Eight voxels are blended for each."""
        return Cost(seconds=voxels * 2.5e-7, bytes=voxels * 64.0)
