"""Six pictures of a quarter turn each, on one."""

from typing import ClassVar, Literal

from pydantic import Field

from api_schemas.families import LayoutSpec

Arrangement = Literal["column", "row", "cross", "tall_cross"]

_PROPORTIONS = {"column": (1, 6), "row": (6, 1), "cross": (4, 3), "tall_cross": (3, 4)}


class CubeSpec(LayoutSpec):
    """The faces of a cube round the middle of the world.

    In a column or row they are +x, -x, +y, -y, +z, -z. Crosses are folded round the face in their
    middle, -z of openexr and +z of gl; the lowest face of a tall cross stands on its head.
    """

    source: ClassVar[str] = "Greene, 1986; OpenGL 1.3, 2001; OpenEXR, 2003"
    equation: ClassVar[str] = "(s, t) = ((right, up) / |largest of x, y, z| + 1) / 2 on its face"

    technique: Literal["cube"]
    arrangement: Arrangement = Field(
        default="column",
        description="Where the faces are: below each other, beside each other, or unfolded, four "
        "wide or four high.",
    )
    orientation: Literal["openexr", "gl"] = Field(
        default="openexr",
        description="Whether a face is right as seen from within, as photographs are and OpenEXR "
        "has it, or mirrored, as OpenGL has it.",
    )

    @property
    def proportion(self) -> tuple[int, int]:
        """As many faces wide and high as the arrangement is."""
        return _PROPORTIONS[self.arrangement]
