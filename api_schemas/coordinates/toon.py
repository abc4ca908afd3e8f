"""Tone and detail: what cartoons are coloured with."""

from typing import ClassVar, Literal

from pydantic import Field

from api_schemas.base import Length, NonNegative
from api_schemas.families import CoordinatesSpec


class ToonSpec(CoordinatesSpec):
    """Along u how far the surface faces a lamp, along v how much of the detail is wanted.

    The rows of the picture are palettes, the lowest for the least detail.
    """

    source: ClassVar[str] = "Barla, Thollot and Markosian, 2006; Lake et al., 2000"
    equation: ClassVar[str] = (
        "u = max(0, max over lights of n.l); v = |n.r|^power (facing), |m.r|^power with m the "
        "mirrored lamp (highlight), 1 - log(z / near) / log(far / near) (distance)"
    )
    dimensions: ClassVar[Literal[2, 3]] = 2

    technique: Literal["toon"]
    detail: Literal["facing", "highlight", "distance"] = Field(
        default="facing",
        description="Where the rows higher up are used: where the surface faces the eye and not at "
        "its outline, where it shines, or near the eye.",
    )
    power: NonNegative = Field(
        default=1.0,
        description="How narrow these two are: larger keeps the upper rows in the middle.",
    )
    near: Length = Field(
        default=1.0, description="Up to this distance from the eye the uppermost row is used."
    )
    far: Length = Field(
        default=100.0,
        description="From this distance on the lowest row is used; not above near, a step.",
    )
