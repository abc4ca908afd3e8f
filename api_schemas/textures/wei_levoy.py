"""Texture grown in scan order from coarse to fine, each pixel by the nearest neighbourhood."""

from collections.abc import Mapping
from typing import Annotated, ClassVar, Literal

from pydantic import Field

from api_schemas.base import WHOLE
from api_schemas.by_example import MixedSpec
from api_schemas.cost import Cost


class WeiLevoySpec(MixedSpec):
    """Grows smooth random things, such as clouds, water and fur, a little soft. It always tiles."""

    source: ClassVar[str] = "Wei and Levoy, 2000"
    equation: ClassVar[str] = "argmin over all q of |N(p) - N(q)|^2, coarse neighbourhoods included"

    technique: Literal["wei_levoy"]
    neighbourhood: Annotated[int, Field(ge=1, le=4), WHOLE] = Field(
        default=3,
        description="How many pixels to each side and above have to fit, on each level: more "
        "keeps larger things, slowly.",
    )
    levels: Annotated[int, Field(ge=1, le=6), WHOLE] = Field(
        default=3,
        description="From how coarse a picture it begins: each level doubles what is seen at once.",
    )

    def cost_from(self, within: Mapping[str, int], pixels: int) -> Cost:
        """Every neighbourhood is compared with every other of its level, by a matrix product."""
        grown = self.size[0] * self.size[1]
        reach = self.neighbourhood
        numbers = 4.0 * (2 * reach * (reach + 1) + 25)
        return Cost(
            seconds=float(grown) * within["exemplar"] * numbers * 8e-11
            + grown * 4e-5
            + pixels * 5e-8,
            bytes=grown * 100.0 + within["exemplar"] * (8 * numbers + 4 * 512) + pixels * 64.0,
        )
