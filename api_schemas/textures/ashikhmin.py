"""Texture grown pixel by pixel out of pieces of an exemplar."""

from collections.abc import Mapping
from typing import Annotated, ClassVar, Literal

from pydantic import Field

from api_schemas.base import WHOLE
from api_schemas.by_example import GuidedSpec
from api_schemas.cost import Cost

Reach = Annotated[int, Field(ge=1, le=10), WHOLE]


class AshikhminSpec(GuidedSpec):
    """Grows grass, leaves, gravel, flowers: irregular things in clear pieces. It always tiles."""

    source: ClassVar[str] = "Ashikhmin, 2001"
    equation: ClassVar[str] = (
        "s(p) = argmin over q in {s(p + d) - d} of the sum over e of |target(p + e) - exemplar(q + "
        "e)|^2, with d and e in the neighbourhood"
    )

    technique: Literal["ashikhmin"]
    neighbourhood: Annotated[list[Reach], Field(min_length=2, max_length=2)] = Field(
        default=[2, 2],
        description="How many columns to each side and how many rows above a pixel has to fit to: "
        "more makes larger pieces.",
    )
    passes: Annotated[int, Field(ge=1, le=16), WHOLE] = Field(
        default=3,
        description="How often the picture is gone over: first from the upper left, then, with "
        "all of the square around a pixel, to and fro.",
    )

    def cost_from(self, within: Mapping[str, int], pixels: int) -> Cost:
        """Each pixel compares its neighbourhood with a candidate for each of its neighbours."""
        grown = self.size[0] * self.size[1]
        window = (2 * self.neighbourhood[0] + 1) * (2 * self.neighbourhood[1] + 1)
        return Cost(
            seconds=grown * (self.passes * window * 4e-8 * (1 + window / 100) + 2e-6)
            + within["exemplar"] * 1e-6
            + pixels * 5e-8,
            bytes=grown * 80.0 + within["exemplar"] * 120.0 + pixels * 64.0,
        )
