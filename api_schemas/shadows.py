"""Shadows: what a light does not reach."""

from typing import Annotated

from pydantic import Field

from api_schemas.base import WHOLE, Schema

RESOLUTION_MIN = 64
"""Room for the widest soft edge on both sides of a map."""


class Shadow(Schema):
    """A shadow map: a picture of the distances that the light sees (Williams, 1978).

    Surfaces whose alpha_mode is mask cast the shadow of what is not cut out, those that are blended
    of what hides at least half.
    """

    resolution: Annotated[int, Field(ge=RESOLUTION_MIN, le=4096), WHOLE] = Field(
        default=1024,
        description="Texels along each side of the map, or of each of six faces round a point: "
        "more draw finer edges, and take more time and memory.",
    )
    bias: Annotated[float, Field(ge=0, le=64)] = Field(
        default=1.0,
        description="How far in texels a surface is held off the shadow that it casts itself: too "
        "little shows stripes on curved things, too much detaches shadows from what casts them.",
    )
    radius: Annotated[int, Field(ge=0, le=8), WHOLE] = Field(
        default=1,
        description="Softness of the edge: it fades over 2 radius + 2 texels (Reeves, Salesin and "
        "Cook, 1987).",
    )
