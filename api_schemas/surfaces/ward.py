"""Ward's model of rough and brushed surfaces."""

from __future__ import annotations

from typing import ClassVar, Literal

from pydantic import Field

from api_schemas.maps import MappableColor, MappableNonNegative
from api_schemas.scratched import ScratchedSpec
from api_schemas.surface_spec import STREAK_LOOKUPS


class WardSpec(ScratchedSpec):
    """Light scattered by scratches: an elliptical highlight, fitted to measurements."""

    revision: ClassVar[int] = 2
    streaks: ClassVar[bool] = True
    sums_sky: ClassVar[bool] = True
    source: ClassVar[str] = "Ward, 1992"
    equation: ClassVar[str] = (
        "f = rd / pi + rs exp(-tan^2 d (cos^2 p / ax^2 + sin^2 p / ay^2)) "
        "/ (4 pi ax ay sqrt(cos i cos o)), d and p of the half vector"
    )

    technique: Literal["ward"]
    diffuse_color: MappableColor = Field(
        default=[0.1, 0.1, 0.1], description="Linear colour of the matt part (rd)."
    )
    specular_color: MappableColor = Field(
        default=[0.5, 0.5, 0.5], description="Linear colour of the glossy part (rs)."
    )
    roughness_along: MappableNonNegative = Field(
        default=0.1,
        description="How far light spreads along the scratches (ax), as a slope; below 0.001 "
        "counts as that.",
    )
    roughness_across: MappableNonNegative = Field(
        default=0.4, description="The same across the scratches (ay): larger makes a longer streak."
    )
    emission: MappableColor = Field(
        default=[0.0, 0.0, 0.0], description="Linear radiance the surface adds by itself."
    )

    @property
    def sky_lookups(self) -> int:
        """A streak is as many mirrors."""
        return STREAK_LOOKUPS
