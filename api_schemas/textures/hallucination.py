"""A picture enlarged, with detail that an exemplar has."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Annotated, ClassVar, Literal

from pydantic import Field

from api_schemas.by_example import FromExemplarSpec
from api_schemas.cost import Cost
from api_schemas.members import Texture
from api_schemas.own_size import OWN_SIZE


class HallucinationSpec(FromExemplarSpec):
    """Makes a small picture two or four times as large, with the exemplar's detail.

    Made small again it is the picture it was. The output's size should be the enlarged one.
    """

    revision: ClassVar[int] = 2
    source: ClassVar[str] = "Sun, Zhu and Tappen, 2010; Irani and Peleg, 1991 (back-projection)"
    equation: ClassVar[str] = "x <- x + up(target - down(x)), x of the exemplar's patches"
    layers: ClassVar[tuple[str, ...]] = ("source",)

    technique: Literal["hallucination"]
    target: Annotated[Texture, OWN_SIZE] = Field(description="The small picture, at its own size.")
    factor: Literal[2, 4] = Field(default=2, description="How many times as large it becomes.")

    def cost_from(self, within: Mapping[str, int], pixels: int) -> Cost:
        """Like texture optimisation of the enlarged picture."""
        grown = within.get("target", within["exemplar"]) * self.factor**2
        return Cost(
            seconds=grown * 1.2e-5 + within["exemplar"] * 3e-6 + pixels * 5e-8,
            bytes=grown * 240.0 + within["exemplar"] * 240.0 + pixels * 64.0,
        )
