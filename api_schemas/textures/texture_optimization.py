"""New texture of which every patch looks like one of the exemplar's."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Annotated, ClassVar, Literal

from pydantic import Field

from api_schemas.by_example import GuidedSpec
from api_schemas.cost import Cost


class TextureOptimizationSpec(GuidedSpec):
    """Grows more of any texture: the one to begin with, quick, tileable, and seldom the worst.

    No line of pixels longer than half of the exemplar is copied, where it has room for others.
    """

    revision: ClassVar[int] = 3
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
        default=0.25,
        description="How much the distance to edges counts beside colour: it keeps stones and "
        "bricks whole.",
    )

    def cost_from(self, within: Mapping[str, int], pixels: int) -> Cost:
        """All levels together are a third larger than the finest, whose patches are fewer."""
        grown = self.size[0] * self.size[1]
        return Cost(
            seconds=grown * 8e-6 + within["exemplar"] * 2e-6 + pixels * 2e-8,
            bytes=grown * 135.0 + within["exemplar"] * 200.0 + pixels * 16.0,
        )
