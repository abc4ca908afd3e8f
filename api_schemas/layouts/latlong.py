"""Longitude and latitude as u and v."""

from typing import ClassVar, Literal

from pydantic import Field

from api_schemas.families import LayoutSpec, Wrap


class LatlongSpec(LayoutSpec):
    """Longitude runs along u, latitude along v; right as seen from within.

    Programs that write such pictures differ in which direction is in the middle, and in nothing
    else.
    """

    source: ClassVar[str] = "Blinn and Newell, 1976; Hughes et al., 2013, section 20.4"
    equation: ClassVar[str] = "+z: (u, v) = (1/2 - atan2(x, z) / 2 pi, 1/2 + asin(y) / pi)"

    technique: Literal["latlong"]
    centre: Literal["+z", "+x", "-z", "-x"] = Field(
        default="+z",
        description="Which direction is in the middle of the picture: +z of OpenEXR and Mitsuba, "
        "+x of three.js and Blender, -z of MaterialX, -x of the textbook.",
    )

    @property
    def joins(self) -> tuple[Wrap, Wrap]:
        """It goes round."""
        return ("repeat", "clamp")

    @property
    def proportion(self) -> tuple[int, int]:
        """Twice as wide as high."""
        return (2, 1)
