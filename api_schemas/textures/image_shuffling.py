"""A picture of which a part has been moved."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Annotated, ClassVar, Literal

from pydantic import Field

from api_schemas.base import WHOLE
from api_schemas.by_example import EXEMPLAR_SIDE_MAX, MaterialSpec
from api_schemas.cost import Cost
from api_schemas.maps import DATA
from api_schemas.members import Texture
from api_schemas.own_size import LIKE_EXEMPLAR

Shift = Annotated[int, Field(ge=-EXEMPLAR_SIDE_MAX, le=EXEMPLAR_SIDE_MAX), WHOLE]


class ImageShufflingSpec(MaterialSpec):
    """Moves a part of the exemplar; what it leaves behind and its surroundings are made anew.

    The output's size should be the exemplar's. What is moved beyond its edges is cut off.
    """

    revision: ClassVar[int] = 2
    source: ClassVar[str] = "Simakov et al., 2008; Cho et al., 2008; Barnes et al., 2009"
    equation: ClassVar[str] = "picture'(p + shift) = picture(p) for p in the region"

    technique: Literal["image_shuffling"]
    region: Annotated[Texture, LIKE_EXEMPLAR, DATA] = Field(
        description="Where its first channel is at least 0.5, the picture moves. Of another size, "
        "it is brought to the exemplar's."
    )
    shift: Annotated[list[Shift], Field(min_length=2, max_length=2)] = Field(
        description="How many pixels it moves to the right, and down."
    )
    margin: Annotated[int, Field(ge=0, le=64), WHOLE] = Field(
        default=8,
        description="How far around the region, where it was and where it comes to lie, the "
        "picture is made anew, in pixels.",
    )

    def cost_from(self, within: Mapping[str, int], pixels: int) -> Cost:
        """As if all of the picture were made anew."""
        return Cost(
            seconds=within["exemplar"] * 1.2e-5 + pixels * 5e-8,
            bytes=within["exemplar"] * 320.0 + pixels * 64.0,
        )
