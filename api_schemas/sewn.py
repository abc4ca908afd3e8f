"""What the specs share that sew texture together from square pieces of an exemplar."""

import math
from collections.abc import Mapping
from typing import Annotated, ClassVar

from pydantic import Field

from api_schemas.base import WHOLE
from api_schemas.by_example import MixedSpec
from api_schemas.cost import Cost
from api_schemas.own_size import Size

Block = Annotated[
    int,
    Field(
        ge=2,
        le=256,
        description="Side of the squares in pixels, or that of the exemplar if it is smaller: "
        "larger than what must stay whole, such as a brick.",
    ),
    WHOLE,
]
Overlap = Annotated[
    float,
    Field(
        ge=0.02,
        le=0.5,
        description="How much of a square's side lies over its neighbour: more room for seams to "
        "go around things, and less new in each square.",
    ),
]


class SewnSpec(MixedSpec):
    """Sews squares of an exemplar together, as they lie or turned and mirrored."""

    layers: ClassVar[tuple[str, ...]] = (*MixedSpec.layers, "turn")

    block: Block = 36
    overlap: Overlap = 1 / 6
    tolerance: Annotated[float, Field(ge=0, le=10)] = Field(
        default=0.1,
        description="Squares up to this much worse than the best are taken by chance: 0 repeats "
        "itself, more makes seams.",
    )
    turns: bool = Field(
        default=False,
        description="Whether squares may be turned by quarters: more variety from things seen "
        "from above, such as gravel. The layer turn says how often each was, anticlockwise.",
    )
    flips: bool = Field(
        default=False,
        description="Whether squares may be mirrored; the layer turn is then 4 more: left to "
        "right first, turned after that.",
    )

    @property
    def views(self) -> int:
        """In how many ways a square may lie."""
        return (4 if self.turns else 1) * (2 if self.flips else 1)

    @property
    def rounds(self) -> int:
        """How often the result is covered with squares."""
        return 1

    def cost_from(self, within: Mapping[str, int], pixels: int) -> Cost:
        """Of a square exemplar."""
        side = math.isqrt(within["exemplar"])
        return self.cost_at({"exemplar": (side, side)}, pixels)

    def cost_at(self, sides: Mapping[str, Size], pixels: int) -> Cost:
        """Each square is compared with all of the exemplar, in each way it may lie, and cut."""
        seen = math.prod(sides["exemplar"]) * self.views
        side = min(self.block, *sides["exemplar"])
        step = max(1, round(side * (1 - self.overlap)))
        squares = math.prod(-(-length // step) for length in self.size) * self.rounds
        grown = math.prod(self.size)
        return Cost(
            seconds=squares * (1e-3 + seen * 1.5e-7 + side**2 * 5e-6)
            + grown * 3e-6
            + pixels * 5e-8,
            bytes=grown * 160.0 + seen * 240.0 + side**2 * 800.0 + pixels * 64.0,
        )
