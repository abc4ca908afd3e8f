"""A picture of which a part is made anew out of the rest."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Annotated, ClassVar, Literal

from pydantic import Field

from api_schemas.by_example import MaterialSpec
from api_schemas.cost import Cost
from api_schemas.maps import DATA
from api_schemas.members import Texture
from api_schemas.own_size import LIKE_EXEMPLAR


class HoleFillingSpec(MaterialSpec):
    """Removes what is in a hole: the exemplar, with the hole filled from what is around it.

    The output's size should be the exemplar's. What is outside of the hole stays as it is.
    """

    revision: ClassVar[int] = 2
    source: ClassVar[str] = "Wexler, Shechtman and Irani, 2007; Barnes et al., 2009"
    equation: ClassVar[str] = (
        "minimise the sum over the patches p that touch the hole of min over q outside of it "
        "|picture(p) - picture(q)|^2"
    )

    technique: Literal["hole_filling"]
    hole: Annotated[Texture, LIKE_EXEMPLAR, DATA] = Field(
        description="Where its first channel is at least 0.5, the picture is made anew. Of another "
        "size, it is brought to the exemplar's."
    )

    def cost_from(self, within: Mapping[str, int], pixels: int) -> Cost:
        """As if the hole were all of the picture."""
        return Cost(
            seconds=within["exemplar"] * 1.2e-5 + pixels * 5e-8,
            bytes=within["exemplar"] * 320.0 + pixels * 64.0,
        )
