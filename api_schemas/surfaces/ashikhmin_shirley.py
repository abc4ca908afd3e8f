"""Ashikhmin and Shirley's anisotropic Phong model."""

from __future__ import annotations

from typing import ClassVar, Literal

from pydantic import Field

from api_schemas.maps import MappableColor, MappableNonNegative
from api_schemas.scratched import ScratchedSpec
from api_schemas.surface_spec import STREAK_LOOKUPS


class AshikhminShirleySpec(ScratchedSpec):
    """Brushed and varnished things: an elliptical highlight that brightens at grazing angles."""

    revision: ClassVar[int] = 2
    streaks: ClassVar[bool] = True
    sums_sky: ClassVar[bool] = True
    source: ClassVar[str] = "Ashikhmin and Shirley, 2000"
    equation: ClassVar[str] = (
        "fs = sqrt((nu + 1)(nv + 1)) / (8 pi) "
        "(n.h)^((nu (h.u)^2 + nv (h.v)^2) / (1 - (n.h)^2)) / ((h.k) max(n.k1, n.k2)) F(h.k), "
        "F(c) = Rs + (1 - Rs)(1 - c)^5, "
        "fd = 28 Rd / (23 pi) (1 - Rs)(1 - (1 - n.k1 / 2)^5)(1 - (1 - n.k2 / 2)^5)"
    )

    technique: Literal["ashikhmin_shirley"]
    diffuse_color: MappableColor = Field(
        default=[0.1, 0.1, 0.1], description="Linear colour of the matt part (Rd)."
    )
    specular_color: MappableColor = Field(
        default=[0.5, 0.5, 0.5], description="Linear colour of the glossy part (Rs)."
    )
    exponent_along: MappableNonNegative = Field(
        default=1000.0,
        description="How tight the highlight is along the scratches (nu): larger is narrower.",
    )
    exponent_across: MappableNonNegative = Field(
        default=30.0, description="The same across the scratches (nv): smaller makes a streak."
    )
    emission: MappableColor = Field(
        default=[0.0, 0.0, 0.0], description="Linear radiance the surface adds by itself."
    )

    @property
    def sky_lookups(self) -> int:
        """A streak is as many mirrors."""
        return STREAK_LOOKUPS
