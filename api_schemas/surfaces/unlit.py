"""A surface that shines by itself and needs no light."""

from __future__ import annotations

from typing import ClassVar, Literal

from pydantic import Field

from api_schemas.maps import MappableColor
from api_schemas.surface_spec import SurfaceSpec


class UnlitSpec(SurfaceSpec):
    """Shows its colour as it is, whatever the lights."""

    source: ClassVar[str] = "none needed"
    equation: ClassVar[str] = "L_out = color"

    technique: Literal["unlit"]
    color: MappableColor = Field(
        default=[1.0, 1.0, 1.0], description="Linear radiance; 4.0 reads back as 4.0."
    )
