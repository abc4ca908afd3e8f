"""Two discs seen from far away: above and below."""

from typing import ClassVar, Literal

from pydantic import Field

from api_schemas.families import LayoutSpec


class HemispheresSpec(LayoutSpec):
    """The half with y >= 0 in the left square, that with y <= 0 in the right one."""

    source: ClassVar[str] = "Hughes et al., 2013, section 20.4"
    equation: ClassVar[str] = "(s, t) = ((x + 1) / 2, (z + 1) / 2) in each square"
    whole: ClassVar[bool] = False

    technique: Literal["hemispheres"]
    second: Literal["mirrored", "photograph"] = Field(
        default="mirrored",
        description="Whether the second disc has x to the right too, as the formula says, or to "
        "the left, as a photograph of what is below has it.",
    )

    @property
    def proportion(self) -> tuple[int, int]:
        """Two squares side by side."""
        return (2, 1)
