"""New texture of which every patch looks like one of the exemplar's."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Annotated, ClassVar, Literal

from pydantic import Field

from api_schemas.by_example import GrownSpec
from api_schemas.cost import Cost
from api_schemas.maps import DATA
from api_schemas.own_size import LIKE_EXEMPLAR, LIKE_RESULT

if TYPE_CHECKING:
    from api_schemas.language import Texture


class TextureOptimizationSpec(GrownSpec):
    """Grows more of any texture: the one to begin with, quick, tileable, and seldom the worst."""

    source: ClassVar[str] = (
        "Kwatra, Essa, Bobick and Kwatra, 2005; Han et al., 2006; Kaspar et al., 2015"
    )
    equation: ClassVar[str] = (
        "minimise the sum over all patches p of min over q |target(p) - exemplar(q)|^2"
    )

    technique: Literal["texture_optimization"]
    tileable: bool = Field(
        default=True, description="Whether the result goes on seamlessly around its edges."
    )
    variety: Annotated[float, Field(ge=0, le=10)] = Field(
        default=1.0,
        description="How evenly all of the exemplar is used: 0 lets what fits easily take over, "
        "more brings rare things back more often.",
    )
    outlines: Annotated[float, Field(ge=0, le=1)] = Field(
        default=1.0,
        description="How much the distance to edges counts beside colour: it keeps stones and "
        "bricks whole.",
    )
    guide: Annotated[Texture | None, LIKE_RESULT] = Field(
        default=None,
        description="A picture the result follows: where it is like a place of exemplar_guide, "
        "that place of the exemplar is preferred.",
    )
    exemplar_guide: Annotated[Texture | None, LIKE_EXEMPLAR] = Field(
        default=None, description="What the guide is compared with; by default the exemplar itself."
    )
    guide_weight: Annotated[float, Field(ge=0, le=1)] = Field(
        default=0.5,
        description="How much the guide counts: 0 not at all, 0.5 as much as the texture, 1 alone.",
    )
    keep: Annotated[Texture | None, LIKE_RESULT] = Field(
        default=None,
        description="A picture parts of which are finished: they stay as they are, and the texture "
        "grows around them.",
    )
    keep_mask: Annotated[Texture | None, LIKE_RESULT, DATA] = Field(
        default=None,
        description="Where its first channel is at least 0.5, keep stays; by default where keep "
        "has alpha above 0.",
    )

    def cost_from(self, within: Mapping[str, int], pixels: int) -> Cost:
        """All levels together are a third larger than the finest, whose patches are fewer."""
        grown = self.size[0] * self.size[1]
        return Cost(
            seconds=grown * 8e-6 + within["exemplar"] * 2e-6 + pixels * 2e-8,
            bytes=grown * 120.0 + within["exemplar"] * 200.0 + pixels * 16.0,
        )
