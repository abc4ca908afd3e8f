"""A normal map of a relief."""

from __future__ import annotations

from typing import Annotated, ClassVar, Literal

from pydantic import Field

from api_schemas.cost import Cost
from api_schemas.families import Meaning, TextureSpec
from api_schemas.maps import DATA
from api_schemas.members import Texture


class NormalFromHeightSpec(TextureSpec):
    """The tangent-space normal map of a height field: bumps without geometry, green up."""

    source: ClassVar[str] = "Blinn, 1978"
    equation: ClassVar[str] = "n = (-h_u, -h_v, 1) / |(-h_u, -h_v, 1)|, h = depth height(u, v)"
    meaning: ClassVar[Meaning] = "data"

    technique: Literal["normal_from_height"]
    height: Annotated[Texture, DATA] = Field(
        description="The relief: its first channel, 1 is high; it goes on around its edges."
    )
    depth: Annotated[float, Field(ge=-16, le=16)] = Field(
        default=0.05,
        description="How high a value of 1 stands, in tiles: more is bumpier, negative turns "
        "bumps into dents.",
    )
    range: Literal["unit", "signed"] = Field(
        default="unit",
        description="Components from -1..1 packed into 0..1, as files of normal maps have them, "
        "or as they are.",
    )

    def cost(self, pixels: int) -> Cost:
        """Four neighbours are read for each pixel, three numbers written."""
        return Cost(seconds=pixels * 5e-8, bytes=pixels * 20.0)
