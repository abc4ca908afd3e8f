"""The relief behind a normal map."""

from __future__ import annotations

from typing import Annotated, ClassVar, Literal

from pydantic import Field

from api_schemas.cost import Cost
from api_schemas.normal_reading import NormalReadingSpec


class HeightFromNormalSpec(NormalReadingSpec):
    """Finds the relief whose normals come nearest to those of a normal map.

    The report tells `not_integrable`, the share of the slopes' energy that no relief has, and
    `tilt`, the mean slopes along u and v, which no tile can have either.
    """

    source: ClassVar[str] = "Frankot and Chellappa, 1988"
    equation: ClassVar[str] = "H = -i (k_u P + k_v Q) / (k_u^2 + k_v^2), p = -n_x/n_z, q = -n_y/n_z"

    technique: Literal["height_from_normal"]
    depth: Annotated[float, Field(ge=1e-4, le=16)] = Field(
        default=0.05, description="How many tiles high a value of 1 stands: less is more contrast."
    )
    range: Literal["unit", "signed"] = Field(
        default="unit", description="Whether the mean of the heights is 0.5 or 0."
    )

    def cost(self, pixels: int) -> Cost:
        """Three Fourier transforms."""
        return Cost(seconds=pixels * 8e-7, bytes=pixels * 160.0)
