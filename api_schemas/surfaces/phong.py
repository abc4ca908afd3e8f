"""The Phong model with every term mappable."""

from __future__ import annotations

from typing import ClassVar, Literal, Self

from pydantic import Field

from api_schemas.maps import MappableColor, MappableNonNegative
from api_schemas.surface_spec import SurfaceSpec


class PhongSpec(SurfaceSpec):
    """Ambient, diffuse and specular light, each with a weight and a colour of its own."""

    source: ClassVar[str] = "Phong, 1975; Lafortune and Willems, 1994 (energy normalisation)"
    equation: ClassVar[str] = (
        "L_out = emission + ka Ca La + sum_l [kd Cd max(0, n.l) + ks Cs max(0, r.v)^n] L_l, "
        "r = 2 (n.l) n - l"
    )

    technique: Literal["phong"]
    ambient_weight: MappableNonNegative = Field(
        default=1.0, description="How much of the ambient light comes back (ka)."
    )
    ambient_color: MappableColor | None = Field(
        default=None,
        description="Linear colour in ambient light (Ca); the colour of the matt part without one.",
    )
    diffuse_weight: MappableNonNegative = Field(
        default=1.0, description="How bright the matt part is (kd)."
    )
    diffuse_color: MappableColor = Field(
        default=[0.8, 0.8, 0.8], description="Linear colour of the matt part (Cd)."
    )
    specular_weight: MappableNonNegative = Field(
        default=0.0, description="How bright the highlight is (ks)."
    )
    specular_color: MappableColor = Field(
        default=[1.0, 1.0, 1.0], description="Linear colour of the highlight (Cs)."
    )
    exponent: MappableNonNegative = Field(
        default=32.0,
        description="How tight the highlight is (n): larger is smaller and shinier, and what a map "
        "reads below 0 counts as 0.",
    )
    emission: MappableColor = Field(
        default=[0.0, 0.0, 0.0], description="Linear radiance the surface adds by itself."
    )
    normalization: Literal["none", "energy"] = Field(
        default="none",
        description="none is the formula as written; energy divides the matt part by pi and "
        "weights the highlight by (n + 2) / (2 pi) and n.l: a tighter highlight is brighter.",
    )

    def filled(self) -> Self:
        """Let the ambient colour follow the matt one where it is not given."""
        if self.ambient_color is not None:
            return self
        return self.model_copy(update={"ambient_color": self.diffuse_color})
