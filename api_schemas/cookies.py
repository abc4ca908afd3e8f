"""Pictures before lights: slides, windows, leaves."""

from typing import Annotated

from pydantic import Field

from api_schemas.base import Length, Number, Schema, Vector
from api_schemas.families import Wrap
from api_schemas.maps import COLOUR, PictureFilter, TextureTransform
from api_schemas.members import Texture

COOKIES_MAX = 4
"""Different pictures before the lights of one scene: what maps leave of OpenGL's texture units."""


class Cookie(Schema):
    """A picture whose colours multiply the light that goes through it; transparent is dark."""

    texture: Annotated[Texture, COLOUR] = Field(description="The picture, of any technique.")
    up: Vector = Field(
        default=[0.0, 1.0, 0.0],
        description="Which way is up in the picture, for somebody who looks along the light; where "
        "the light goes along it, +x.",
    )
    transform: TextureTransform = Field(
        default=TextureTransform(), description="Moves, turns and repeats the picture."
    )
    wrap: Annotated[list[Wrap], Field(min_length=2, max_length=2)] = Field(
        default=["border", "border"],
        description="What lies beyond the picture along u and v: copies, mirrored copies, the edge "
        "drawn out, or border_color.",
    )
    border_color: Annotated[list[Number], Field(min_length=4, max_length=4)] = Field(
        default=[0.0, 0.0, 0.0, 0.0],
        description="Linear light beyond the picture where wrap is border, with its alpha.",
    )
    filter: PictureFilter = Field(
        default="trilinear",
        description="How texels become a pixel: hard texels, smooth when near, smooth when far, "
        "or sharp at grazing angles too.",
    )

    @property
    def unit(self) -> str:
        """What two cookies that share a texture unit have in common."""
        return self.model_dump_json(include={"texture", "wrap", "border_color", "filter"})


class Slide(Cookie):
    """A picture that a spot light throws like a projector: the square round its cone shows it."""

    aspect: Length = Field(
        default=1.0, description="Width over height of the picture; the longer side fills the cone."
    )


class Gobo(Cookie):
    """A picture that parallel light goes through, drawn out along the light without end."""

    width: Length = Field(default=2.0, description="How wide it is in the scene.")
    height: Length = Field(default=2.0, description="How high it is in the scene.")
    centre: Vector = Field(
        default=[0.0, 0.0, 0.0], description="A point in the scene that its middle falls on."
    )
