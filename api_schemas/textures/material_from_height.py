"""All maps of a material from its relief."""

from __future__ import annotations

import math
from typing import Annotated, ClassVar, Literal

from pydantic import Field

from api_schemas.cost import Cost
from api_schemas.families import TextureSpec
from api_schemas.maps import DATA
from api_schemas.members import Texture
from api_schemas.textures.ramp import RampStop

DIRECTIONS = 16

Share = Annotated[float, Field(ge=0, le=1)]
_STONE = [
    RampStop(position=0.0, color=[0.06, 0.045, 0.035]),
    RampStop(position=1.0, color=[0.42, 0.36, 0.3]),
]


class MaterialFromHeightSpec(TextureSpec):
    """Makes a whole material of one relief: its colour, and as layers all that a surface needs.

    `height` is the relief itself. `normal` has length one, x along u, y along v. `occlusion` is the
    share of an even sky that a point sees. `curvature` is 0.5 where it is flat, more on ridges,
    less in creases. `roughness` leads from hollows to peaks.
    """

    source: ClassVar[str] = (
        "Blinn, 1978 (normals); Max, 1988, and Jimenez et al., 2016 (horizons and occlusion)"
    )
    equation: ClassVar[str] = (
        "occlusion = mean over azimuths of the integral of max(n.w, 0) between both horizons; "
        "curvature = 1/2 - radius H / 2, H = ((1 + h_v^2) h_uu - 2 h_u h_v h_uv + "
        "(1 + h_u^2) h_vv) / (2 (1 + h_u^2 + h_v^2)^(3/2))"
    )
    layers: ClassVar[tuple[str, ...]] = (
        "height",
        "normal",
        "occlusion",
        "curvature",
        "roughness",
    )

    technique: Literal["material_from_height"]
    height: Annotated[Texture, DATA] = Field(
        description="The relief: its first channel, 1 is high; it goes on around its edges."
    )
    depth: Annotated[float, Field(ge=0, le=1)] = Field(
        default=0.05, description="How high a value of 1 stands, in tiles: more is bumpier."
    )
    stops: Annotated[list[RampStop], Field(min_length=1, max_length=64)] = Field(
        default=_STONE, description="Colours by height; beyond the ends the end colours go on."
    )
    cavity: Share = Field(
        default=0.5, description="How much the colour darkens where little of the sky is seen."
    )
    roughness: Annotated[list[Share], Field(min_length=2, max_length=2)] = Field(
        default=[0.9, 0.5], description="Roughness where the height is 0, and where it is 1."
    )
    reach: Annotated[float, Field(ge=0, le=0.5)] = Field(
        default=0.1,
        description="How far away, in tiles, something may stand and still hide the sky.",
    )
    curvature_radius: Annotated[float, Field(ge=1e-4, le=1)] = Field(
        default=0.01,
        description="Radius, in tiles, of the ball whose curvature is shown as 1: less shows finer "
        "detail weaker.",
    )

    def cost(self, pixels: int) -> Cost:
        """Every pixel looks around in all directions, as far as the reach."""
        looks = DIRECTIONS * (1 + self.reach * math.sqrt(pixels))
        return Cost(seconds=pixels * (4e-7 + 1e-8 * looks), bytes=pixels * 200.0)
