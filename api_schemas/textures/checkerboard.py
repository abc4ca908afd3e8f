"""Two colours in squares."""

from typing import Annotated, ClassVar, Literal

from pydantic import Field

from api_schemas.base import WHOLE, Color
from api_schemas.families import TextureSpec

Cells = Annotated[int, Field(ge=1, le=4096), WHOLE]


class CheckerboardSpec(TextureSpec):
    """Squares of two colours, averaged exactly over each pixel."""

    source: ClassVar[str] = "Hughes et al., 2013, section 20.7"
    equation: ClassVar[str] = "colors[(floor(nu u) + floor(nv v) + floor(nw w)) mod 2]"
    solid: ClassVar[bool] = True

    technique: Literal["checkerboard"]
    cells: Annotated[list[Cells], Field(min_length=2, max_length=3)] = Field(
        default=[8, 8],
        description="Squares per tile along u and v, and of a solid along w, by default as along "
        "u; even numbers repeat without a seam.",
    )
    colors: Annotated[list[Color], Field(min_length=2, max_length=2)] = Field(
        default=[[0.85, 0.85, 0.85], [0.15, 0.15, 0.15]],
        description="Linear colour of the square at the lower left corner, and of its neighbours.",
    )

    def has_formula(self) -> bool:
        """Always."""
        return True
