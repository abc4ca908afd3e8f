"""A picture brought to another size without squeezing it."""

import math
from collections.abc import Mapping
from typing import Annotated, ClassVar, Literal

from pydantic import Field

from api_schemas.by_example import GrownMaterialSpec
from api_schemas.cost import Cost
from api_schemas.own_size import Size

STEPS_MAX = 12
LARGEST_CHANGE = 0.12


class RetargetingSpec(GrownMaterialSpec):
    """Brings a picture to another size by leaving out, or repeating, what is missed least.

    Nothing is squeezed or stretched; the order of things stays. It knows nothing of what they are:
    faces may be cut where their parts look alike. At its own size it is the exemplar itself.
    """

    revision: ClassVar[int] = 2
    source: ClassVar[str] = "Simakov, Caspi, Shechtman and Irani, 2008; Pritch et al., 2009"
    equation: ClassVar[str] = (
        "minimise the sum over patches p of min over q |target(p) - exemplar(q)|^2 + "
        "price of having used q, from size to size"
    )

    technique: Literal["retargeting"]
    completeness: Annotated[float, Field(ge=0, le=10)] = Field(
        default=0.3,
        description="How much it counts that all of the exemplar is seen again: 0 may drop what "
        "is hard to fit, and repeat what is not; much breaks things up.",
    )

    def sizes(self, exemplar: tuple[int, int]) -> list[tuple[int, int]]:
        """Return heights and widths on the way from the exemplar's to the wanted ones."""
        wanted = (self.size[1], self.size[0])
        change = max(abs(math.log(b / a)) for a, b in zip(exemplar, wanted, strict=True))
        steps = min(STEPS_MAX, max(1, math.ceil(change / LARGEST_CHANGE)))
        on_the_way = [
            [round(a * (b / a) ** (step / steps)) for a, b in zip(exemplar, wanted, strict=True)]
            for step in range(1, steps + 1)
        ]
        return [(height, width) for height, width in on_the_way]

    def cost_from(self, within: Mapping[str, int], pixels: int) -> Cost:
        """Of a square exemplar."""
        side = math.isqrt(within["exemplar"])
        return self.cost_at({"exemplar": (side, side)}, pixels)

    def cost_at(self, sides: Mapping[str, Size], pixels: int) -> Cost:
        """Every size on the way is grown as texture is."""
        width, height = sides["exemplar"]
        sizes = [math.prod(size) for size in self.sizes((height, width))]
        return Cost(
            seconds=sum(sizes) * 8e-6 + len(sizes) * width * height * 2e-6 + pixels * 2e-8,
            bytes=max(sizes) * 140.0 + width * height * 220.0 + pixels * 16.0,
        )
