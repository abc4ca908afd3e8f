"""Pictures before lights: slides, windows, leaves, pierced lanterns."""

from abc import abstractmethod
from typing import Annotated

from pydantic import Field

from api_schemas.base import Length, Number, Schema, Vector
from api_schemas.families import Wrap
from api_schemas.maps import COLOUR, PictureFilter, TextureTransform
from api_schemas.members import Layout, Texture
from api_schemas.transforms import Quaternion

COOKIES_MAX = 4
"""Different pictures before the lights of one scene: what maps leave of OpenGL's texture units."""


class Cookie(Schema):
    """A picture whose colours multiply the light that goes through it; transparent is dark."""

    texture: Annotated[Texture, COLOUR] = Field(description="The picture, of any technique.")
    filter: PictureFilter = Field(
        default="trilinear",
        description="How texels become a pixel: hard texels, smooth when near, smooth when far, "
        "or sharp at grazing angles too.",
    )

    @property
    @abstractmethod
    def joins(self) -> tuple[Wrap, Wrap]:
        """What lies beyond the picture along u and v."""

    @property
    def unit(self) -> str:
        """What two cookies that share a texture unit have in common."""
        shared = {"texture", "filter", "wrap", "border_color", "layout"}
        return self.model_dump_json(include=shared)


class ThrownPicture(Cookie):
    """A picture that light goes through in one direction."""

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

    @property
    def joins(self) -> tuple[Wrap, Wrap]:
        """As it says."""
        u, v = self.wrap
        return u, v


class Slide(ThrownPicture):
    """A picture that a spot light throws like a projector: the square round its cone shows it."""

    aspect: Length = Field(
        default=1.0, description="Width over height of the picture; the longer side fills the cone."
    )


class Gobo(ThrownPicture):
    """A picture that parallel light goes through, drawn out along the light without end."""

    width: Length = Field(default=2.0, description="How wide it is in the scene.")
    height: Length = Field(default=2.0, description="How high it is in the scene.")
    centre: Vector = Field(
        default=[0.0, 0.0, 0.0], description="A point in the scene that its middle falls on."
    )


class Lantern(Cookie):
    """A picture all round a lamp, as on its shade: on the walls it reads as seen from the lamp."""

    layout: Layout = Field(
        default={"technique": "latlong"},
        validate_default=True,
        description="How directions away from the lamp lie on the picture.",
    )
    rotation: Quaternion = Field(
        default=[0.0, 0.0, 0.0, 1.0],
        description="Turns the shade: a quaternion x, y, z, w, of any length but zero.",
    )

    @property
    def joins(self) -> tuple[Wrap, Wrap]:
        """As the layout's edges do."""
        return self.layout.joins
