"""A number that grows evenly: what ramps and palettes are read with."""

from typing import ClassVar, Literal

from pydantic import Field

from api_schemas.families import Meaning, TextureSpec


class GradientSpec(TextureSpec):
    """Tells where on the tile a point is, as one number from 0 to 1.

    With a ramp over it, it is a picture of one row, as contours and palettes are.
    """

    source: ClassVar[str] = "Hughes et al., 2013, section 20.4"
    equation: ClassVar[str] = (
        "u; v; min(1, 2 |(u, v) - (1/2, 1/2)|); atan2(v - 1/2, u - 1/2) / 2 pi, from 0 to 1"
    )
    meaning: ClassVar[Meaning] = "data"

    technique: Literal["gradient"]
    along: Literal["u", "v", "radius", "angle"] = Field(
        default="u",
        description="Which way it grows: to the right, upwards, from the middle outwards to 1 at "
        "the edge, or counter-clockwise round the middle.",
    )
