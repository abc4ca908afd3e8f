"""What two parabolic mirrors show."""

from typing import ClassVar, Literal

from pydantic import Field

from api_schemas.families import LayoutSpec


class DualParaboloidSpec(LayoutSpec):
    """The half with z >= 0 in the left square, that with z <= 0 in the right one.

    The first disc is the photograph of a mirror, hence mirrored as seen from within.
    """

    source: ClassVar[str] = "Heidrich and Seidel, 1998; Hughes et al., 2013, exercise 20.4"
    equation: ClassVar[str] = "(s, t) = 1/2 + (x, y) / (2 (1 + |z|)) in each square"
    whole: ClassVar[bool] = False

    technique: Literal["dual_paraboloid"]
    second: Literal["textbook", "photograph"] = Field(
        default="textbook",
        description="Whether the second disc has x to the right too, as the formula says, or to "
        "the left, as the photograph of a second mirror has it.",
    )

    @property
    def proportion(self) -> tuple[int, int]:
        """Two squares side by side."""
        return (2, 1)
