"""What the specs share that work on pictures of all directions."""

from typing import TYPE_CHECKING, Annotated, Literal

from pydantic import Field

from api_schemas.cost import Cost
from api_schemas.families import TextureSpec
from api_schemas.maps import COLOUR
from api_schemas.own_size import OWN_SIZE

if TYPE_CHECKING:
    from api_schemas.language import Layout, Texture


class SphereTextureSpec(TextureSpec):
    """Takes a picture of the light from all directions, and makes another one."""

    environment: Annotated["Texture", OWN_SIZE, COLOUR] = Field(
        description="The light: an upload with its own pixels, or any technique. Alpha is ignored; "
        "what is below zero is dark."
    )
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

    def cost(self, pixels: int) -> Cost:
        """Every direction is looked up a few times, and the source is read."""
        return Cost(seconds=1.0 + pixels * 2e-6, bytes=pixels * 64.0 + 1e8)
