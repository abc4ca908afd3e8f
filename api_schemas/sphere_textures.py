"""What the specs share that work on pictures of all directions."""

import math
from typing import Annotated, ClassVar, Literal

from pydantic import Field

from api_schemas.cost import Cost
from api_schemas.families import TextureSpec
from api_schemas.maps import COLOUR
from api_schemas.members import Layout, Texture
from api_schemas.own_size import OWN_SIZE


class SphereSpec(TextureSpec):
    """Makes a picture of all directions out of another one."""

    cube_side: ClassVar[int] = 512

    layout: "Layout" = Field(
        default={"technique": "latlong"},
        validate_default=True,
        description="How directions lie on that picture.",
    )
    to: "Layout" = Field(
        default={"technique": "latlong"},
        validate_default=True,
        description="How directions lie on the picture that is made.",
    )
    broken_texels: Literal["mend", "refuse"] = Field(
        default="mend",
        description="Whether what is no number counts as dark, and what is infinite as the "
        "brightest that is finite, or the job fails where there is any.",
    )

    @property
    def surface_size(self) -> tuple[int, int]:
        """As many texels as a cube of this side has, in the proportion of the layout."""
        width, height = self.to.proportion
        unit = max(1, round(self.cube_side * math.sqrt(6 / (width * height))))
        return (width * unit, height * unit)

    def cost(self, pixels: int) -> Cost:
        """Every direction is looked up a few times, and the source is read."""
        return Cost(seconds=0.3 + pixels * 1.5e-6, bytes=pixels * 64.0 + 1e8)


class SphereTextureSpec(SphereSpec):
    """Makes it of the light from all directions, and of nothing else."""

    environment: Annotated["Texture", OWN_SIZE, COLOUR] = Field(
        description="The light: an upload with its own pixels, or any technique. Alpha is ignored; "
        "what is below zero is dark."
    )
