"""What shines on the scene. Colours are linear; strengths are in radiometric units."""

from typing import Annotated, Literal

from pydantic import Field

from api_schemas.base import Color, NonNegative, Schema, Vector
from api_schemas.cookies import Gobo, Lantern, Slide
from api_schemas.shadows import Shadow

LIGHTS_MAX = 32
"""Lights of one scene."""

ConeAngle = Annotated[float, Field(ge=0, le=1.5707963267948966)]


class AmbientLight(Schema):
    """The same light from everywhere."""

    type: Literal["ambient"]
    radiance: Color = Field(
        default=[0.1, 0.1, 0.1], description="Linear radiance (La); several ambient lights add up."
    )


class _CastingLight(Schema):
    """A light from somewhere, so that there is a side it does not reach."""

    shadow: Shadow | None = Field(
        default=None, description="How it is kept from what lies behind things; not at all without."
    )


class DirectionalLight(_CastingLight):
    """Parallel light, as from the sun."""

    type: Literal["directional"]
    direction: Vector = Field(description="Where the light travels to; any length but zero.")
    color: Color = Field(default=[1.0, 1.0, 1.0], description="Linear colour.")
    irradiance: NonNegative = Field(
        default=1.0, description="Brightness on a surface that faces the light."
    )
    cookie: Gobo | None = Field(default=None, description="A picture that it goes through.")


class PointLight(_CastingLight):
    """Light from one point, falling with the square of the distance."""

    type: Literal["point"]
    position: Vector = Field(description="Where the light is.")
    color: Color = Field(default=[1.0, 1.0, 1.0], description="Linear colour.")
    intensity: NonNegative = Field(default=1.0, description="Brightness in W/sr.")
    cookie: Lantern | None = Field(
        default=None, description="A picture all round it that its light goes through."
    )


class SpotLight(_CastingLight):
    """A point light that shines into a cone with a soft edge."""

    type: Literal["spot"]
    position: Vector = Field(description="Where the light is.")
    direction: Vector = Field(description="Where the cone points to; any length but zero.")
    color: Color = Field(default=[1.0, 1.0, 1.0], description="Linear colour.")
    intensity: NonNegative = Field(default=1.0, description="Brightness in W/sr inside the cone.")
    inner_angle: ConeAngle = Field(
        default=0.4, description="Half angle in radians up to which the light is full."
    )
    outer_angle: ConeAngle = Field(
        default=0.6,
        description="Half angle in radians where it has faded to nothing; not below inner_angle.",
    )
    cookie: Slide | None = Field(default=None, description="A picture that it throws.")


Light = Annotated[
    AmbientLight | DirectionalLight | PointLight | SpotLight, Field(discriminator="type")
]
