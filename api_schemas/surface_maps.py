"""A picture that says which surface is where."""

from typing import Annotated

from pydantic import Field

from api_schemas.base import Number
from api_schemas.maps import Filter, NumberMap
from api_schemas.surface_spec import Surface

SURFACES_MAX = 16
"""Surfaces of one map: the shape is drawn once for each."""


class SurfaceMap(NumberMap):
    """A map of materials: its numbers, rounded, count the surfaces from 0.

    Numbers beyond are the first or the last one.
    """

    filter: Filter = Field(
        default="nearest",
        description="How texels become a pixel; between numbers that are blended lie others.",
    )
    scale: Number = Field(
        default=255.0, description="Multiplies what is read: 255 gives the codes of a PNG."
    )
    surfaces: Annotated[list[Surface], Field(min_length=1, max_length=SURFACES_MAX)] = Field(
        description="What the numbers mean, from 0."
    )
