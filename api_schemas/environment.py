"""The light from all around a scene, as a picture of all directions."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field

from api_schemas.base import WHOLE, Angle, NonNegative, Schema
from api_schemas.maps import COLOUR
from api_schemas.members import Layout, Texture


class Surroundings(Schema):
    """The rest of the scene as one shape sees it from its middle."""

    layout: Literal["cube", "hemispheres"] = Field(
        default="cube",
        description="What it is rendered to: the six faces of a cube, or two discs, above and "
        "below, of about as many texels, which are finer there and long at the horizon.",
    )
    side: Annotated[int, Field(ge=16, le=512), WHOLE] = Field(
        default=128,
        description="Pixels along each face of the cube, half as many as a disc is wide: more show "
        "finer things in a mirror.",
    )


SKY_LAMPS_SIDE = 16
"""Cells along each side of a cube, in each of which the light that is added up is one lamp."""
SKY_LAMPS = 6 * SKY_LAMPS_SIDE**2


class Environment(Schema):
    """What is infinitely far away, shines on everything, and is seen in mirrors and behind all."""

    texture: Annotated[Texture, COLOUR] = Field(
        description="The light from each direction: an upload with its own pixels, or any "
        "technique. Alpha is ignored."
    )
    layout: Layout = Field(
        default={"technique": "latlong"},
        validate_default=True,
        description="How directions lie on the picture.",
    )
    rotation_y: Angle = Field(
        default=0.0,
        description="Turns it round the vertical, counter-clockwise from above, in radians.",
    )
    intensity: NonNegative = Field(default=1.0, description="Multiplies its light.")
    visible: bool = Field(
        default=True,
        description="Whether it is seen where nothing is, unless the scene has a background.",
    )
    broken_texels: Literal["mend", "refuse"] = Field(
        default="mend",
        description="Whether what is no number counts as dark, and what is infinite as the "
        "brightest that is finite, or the job fails where there is any.",
    )
    gathered: Literal["prefiltered", "sum"] = Field(
        default="prefiltered",
        description="How its light on surfaces is found: looked up in pictures that were blurred "
        "before, or added up from up to 1536 directions at every sample, which is right for the "
        "formula of each surface, coarse for smooth ones, and slow. metallic_roughness, ward and "
        "ashikhmin_shirley can add up; others look up.",
    )
    matt: Literal["sum", "harmonics"] = Field(
        default="sum",
        description="How its light on matt surfaces is found: exactly, or by nine smooth functions "
        "as real-time programs do, a few percent off.",
    )
