"""Six pictures, one for each face of a cube."""

from typing import Annotated, ClassVar, Literal

from pydantic import Field

from api_schemas.cost import Cost
from api_schemas.families import TextureSpec
from api_schemas.layouts.cube import Arrangement, CubeSpec
from api_schemas.maps import COLOUR
from api_schemas.members import Texture
from api_schemas.own_size import OWN_SIZE

FACES = ("front", "right", "back", "left", "top", "bottom")


class SixFacesSpec(TextureSpec):
    """Photographs of a quarter turn each, put on one picture for the layout `cube`.

    Whoever took them looked towards -z, turned to the right three times, and tilted the camera up
    and down from the first. Alpha is ignored.
    """

    source: ClassVar[str] = "Greene, 1986; Hughes et al., 2013, section 20.2"
    equation: ClassVar[str] = "-z, +x, +z, -x, +y, -y: (s, t) = ((right, up) / forward + 1) / 2"

    technique: Literal["six_faces"]
    front: Annotated["Texture", OWN_SIZE, COLOUR] = Field(
        description="Towards -z, as seen from within, as all six are."
    )
    right: Annotated["Texture", OWN_SIZE, COLOUR] = Field(description="Towards +x.")
    back: Annotated["Texture", OWN_SIZE, COLOUR] = Field(description="Towards +z.")
    left: Annotated["Texture", OWN_SIZE, COLOUR] = Field(description="Towards -x.")
    top: Annotated["Texture", OWN_SIZE, COLOUR] = Field(
        description="Towards +y; its lower edge joins the front."
    )
    bottom: Annotated["Texture", OWN_SIZE, COLOUR] = Field(
        description="Towards -y; its upper edge joins the front."
    )
    arrangement: Arrangement = Field(
        default="column",
        description="Where the faces lie on the picture: as the layout that reads it has them.",
    )

    @property
    def layout(self) -> CubeSpec:
        """How directions lie on the picture."""
        return CubeSpec(technique="cube", arrangement=self.arrangement)

    @property
    def surface_size(self) -> tuple[int, int]:
        """Faces of 512 texels."""
        columns, rows = self.layout.proportion
        return (512 * columns, 512 * rows)

    def outer_size(self, size: tuple[int, int]) -> tuple[int, int]:
        """As many of the largest face as the arrangement has places."""
        columns, rows = self.layout.proportion
        side = max(size)
        return (side * columns, side * rows)

    def cost(self, pixels: int) -> Cost:
        """Each pixel is read once, from four texels where faces differ in size."""
        return Cost(seconds=pixels * 3e-7, bytes=pixels * 96.0)
