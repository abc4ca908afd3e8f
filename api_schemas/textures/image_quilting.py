"""Texture sewn together from square patches."""

from collections.abc import Mapping
from typing import Annotated, ClassVar, Literal

from pydantic import Field

from api_schemas.base import WHOLE
from api_schemas.by_example import GrownSpec
from api_schemas.cost import Cost


class ImageQuiltingSpec(GrownSpec):
    """Sews squares of the exemplar together along the seams that are seen least."""

    source: ClassVar[str] = "Efros and Freeman, 2001"
    equation: ClassVar[str] = (
        "E(i, j) = |new - old|^2(i, j) + min(E(i - 1, j - 1), E(i - 1, j), E(i - 1, j + 1))"
    )

    technique: Literal["image_quilting"]
    block: Annotated[int, Field(ge=2, le=256), WHOLE] = Field(
        default=36,
        description="Side of the squares in pixels, or that of the exemplar if it is smaller: "
        "larger than what must stay whole, such as a brick.",
    )
    overlap: Annotated[float, Field(ge=0.02, le=0.5)] = Field(
        default=1 / 6,
        description="How much of a square's side lies over its neighbour: more hides seams better "
        "and shows less of each square.",
    )
    tolerance: Annotated[float, Field(ge=0, le=10)] = Field(
        default=0.1,
        description="Squares up to this much worse than the best are taken by chance: 0 repeats "
        "itself, more makes seams.",
    )

    def cost_from(self, within: Mapping[str, int], pixels: int) -> Cost:
        """Every square's overlap is compared with all of the exemplar."""
        grown = self.size[0] * self.size[1]
        inner = self.block * (1 - self.overlap)
        numbers = 4.0 * grown / inner**2 * 2 * self.overlap * self.block**2
        return Cost(
            seconds=within["exemplar"] * numbers * 5e-10 + grown * 2e-6 + pixels * 5e-8,
            bytes=grown * 80.0 + within["exemplar"] * 120.0 + pixels * 64.0,
        )
