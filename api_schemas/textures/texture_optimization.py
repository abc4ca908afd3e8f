"""New texture of which every patch looks like one of the exemplar's."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Annotated, ClassVar, Literal

from pydantic import Field

from api_schemas.by_example import GuidedSpec
from api_schemas.cost import Cost
from api_schemas.own_size import Size


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
        """Of a square exemplar."""
        side = math.isqrt(within["exemplar"])
        return self.cost_at({"exemplar": (side, side)}, pixels)

    def cost_at(self, sides: Mapping[str, Size], pixels: int) -> Cost:
        """The finest level, and the coarsest, which is searched longest.

        Sizes are halved until the exemplar's short side is 24 to 47 pixels: of a small one little.
        """
        grown, exemplar = math.prod(self.size), math.prod(sides["exemplar"])
        halvings = int(math.log2(max(24, min(sides["exemplar"])) / 24))
        return Cost(
            seconds=grown * (2.2e-6 + 8e-5 / 4**halvings) + exemplar * 2e-6 + pixels * 2e-8,
            bytes=grown * 100.0 + exemplar * 200.0 + pixels * 16.0,
        )
