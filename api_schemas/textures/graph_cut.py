"""Texture sewn together from square patches along the best of all seams."""

from typing import Annotated, ClassVar, Literal

from pydantic import Field

from api_schemas.base import WHOLE
from api_schemas.sewn import Block, Overlap, SewnSpec


class GraphCutSpec(SewnSpec):
    """Sews squares of the exemplar together along seams of any form, and mends the worst.

    Where image_quilting cuts from one side of an overlap to the other and never again, seams may
    run anywhere here, and later squares may hide earlier seams.
    """

    revision: ClassVar[int] = 2
    source: ClassVar[str] = "Kwatra, Schodl, Essa, Turk and Bobick, 2003; Boykov and Jolly, 2001"
    equation: ClassVar[str] = (
        "minimise the sum over all neighbours s, t from squares A, B of "
        "(|A(s) - B(s)| + |A(t) - B(t)|) / (|dA(s)| + |dA(t)| + |dB(s)| + |dB(t)|)"
    )

    technique: Literal["graph_cut"]
    block: Block = 64
    overlap: Overlap = 1 / 3
    passes: Annotated[int, Field(ge=0, le=8), WHOLE] = Field(
        default=2,
        description="How often more squares are laid over the seams, each shown only where that "
        "makes them less visible.",
    )
    tileable: bool = Field(
        default=True, description="Whether the result goes on seamlessly around its edges."
    )

    @property
    def rounds(self) -> int:
        """Once, and once more with each pass."""
        return 1 + self.passes
