"""Noise that looks like an exemplar, made by blending pieces of it."""

from collections.abc import Mapping
from typing import Annotated, ClassVar, Literal

from pydantic import Field

from api_schemas.base import WHOLE
from api_schemas.by_example import GrownSpec
from api_schemas.cost import Cost


class ByExampleNoiseSpec(GrownSpec):
    """Spreads moss, granite, rust or clouds without end: blends of pieces, with the same histogram.

    Quick, and for things without outlines only. It always tiles.
    """

    source: ClassVar[str] = "Heitz and Neyret, 2018"
    equation: ClassVar[str] = "T^-1(sum w_i T(exemplar(p + o_i)) / sqrt(sum w_i^2)), T to Gaussian"
    layers: ClassVar[tuple[str, ...]] = ()

    technique: Literal["by_example_noise"]
    piece: Annotated[int, Field(ge=1, le=1024), WHOLE] = Field(
        default=48,
        description="Pixels between the middles of pieces, at most half the exemplar: larger ones "
        "keep larger things, and show them as often.",
    )

    def cost_from(self, within: Mapping[str, int], pixels: int) -> Cost:
        """Three pieces are blended for each pixel, and the exemplar is sorted."""
        grown = self.size[0] * self.size[1]
        return Cost(
            seconds=grown * 1.5e-6 + within["exemplar"] * 2e-6 + pixels * 5e-8,
            bytes=grown * 240.0 + within["exemplar"] * 160.0 + pixels * 64.0,
        )
