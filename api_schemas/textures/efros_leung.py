"""Texture grown pixel by pixel, each chosen by all that is known around it."""

from collections.abc import Mapping
from typing import Annotated, ClassVar, Literal

from pydantic import Field

from api_schemas.base import WHOLE
from api_schemas.by_example import KeepingSpec
from api_schemas.cost import Cost


class EfrosLeungSpec(KeepingSpec):
    """Grows outwards from a seed, or from what is kept, and compares with all of the exemplar.

    Slow, and careful with structure: regular things go on exactly where the window is larger than
    what repeats.
    """

    source: ClassVar[str] = "Efros and Leung, 1999"
    equation: ClassVar[str] = (
        "a random q with d(q) <= 1.1 min d, d(q) = the mean over the known e of "
        "G(e) |target(p + e) - exemplar(q + e)|^2"
    )

    technique: Literal["efros_leung"]
    window: Annotated[int, Field(ge=3, le=31), WHOLE] = Field(
        default=11,
        description="Side of the square that is compared, in pixels; even ones count as the next "
        "smaller: it should be as large as the largest regular thing.",
    )
    tileable: bool = Field(
        default=False, description="Whether the result goes on seamlessly around its edges."
    )

    def cost_from(self, within: Mapping[str, int], pixels: int) -> Cost:
        """About half of a window is known when its pixel is compared with all of the exemplar."""
        grown = self.size[0] * self.size[1]
        comparisons = float(grown) * within["exemplar"] * self.window**2
        return Cost(
            seconds=comparisons * 6e-10 + grown * 1e-5 + pixels * 5e-8,
            bytes=grown * 100.0 + within["exemplar"] * 120.0 + pixels * 64.0,
        )
