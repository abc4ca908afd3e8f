"""The Phong model with a highlight that is longer along one direction than across it."""

from __future__ import annotations

from typing import ClassVar, Literal

from pydantic import Field

from api_schemas.maps import MappableColor, MappableNonNegative, MappableNumber
from api_schemas.scratched import ScratchedSpec


class BrushedMetalSpec(ScratchedSpec):
    """Metal with fine scratches in one direction: the dot product of the highlight is mapped."""

    revision: ClassVar[int] = 2
    source: ClassVar[str] = "Hughes et al., 2013, exercise 20.1; Phong, 1975"
    equation: ClassVar[str] = (
        "L_out = emission + Ca La + sum_l [Cd max(0, n.l) + Cs max(0, r^T M v)^n] L_l, "
        "M = V diag(s, t, 1) V^T, V = [t1 t2 n]"
    )

    technique: Literal["brushed_metal"]
    diffuse_color: MappableColor = Field(
        default=[0.1, 0.1, 0.1],
        description="Linear colour of the matt part (Cd), in ambient light too (Ca).",
    )
    specular_color: MappableColor = Field(
        default=[0.8, 0.8, 0.8], description="Linear colour of the highlight (Cs)."
    )
    exponent: MappableNonNegative = Field(
        default=32.0,
        description="How tight the highlight is (n), where it is tightest: larger is smaller.",
    )
    along: MappableNumber = Field(
        default=0.3,
        description="How much a tilt along the scratches takes from the highlight (s): 1 as much "
        "as in Phong's model, 0 nothing, so that it becomes a streak; a map is cut off to 0..1.",
    )
    across: MappableNumber = Field(
        default=1.0, description="The same for a tilt across the scratches (t)."
    )
    emission: MappableColor = Field(
        default=[0.0, 0.0, 0.0], description="Linear radiance the surface adds by itself."
    )
