"""The surface of glTF 2.0."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, ClassVar, Literal

from pydantic import Field

from api_schemas.families import SurfaceSpec

if TYPE_CHECKING:
    from api_schemas.language import MappableColor, MappableNonNegative


class MetallicRoughnessSpec(SurfaceSpec):
    """Microfacets of metal or of a dielectric over a matt base, with a clear coat."""

    source: ClassVar[str] = "Khronos, glTF 2.0, appendix B, 2021; Walter et al., 2007; Heitz, 2014"
    equation: ClassVar[str] = (
        "f = mix((1 - F) c / pi, 0, metallic) + D V F, alpha = roughness^2, "
        "F = F0 + (1 - F0)(1 - v.h)^5, F0 = mix(((ior - 1) / (ior + 1))^2 specular, c, metallic)"
    )

    technique: Literal["metallic_roughness"]
    base_color: MappableColor = Field(
        default=[1.0, 1.0, 1.0],
        description="Linear colour of the matt part, or of the reflection of a metal.",
    )
    metallic: MappableNonNegative = Field(
        default=1.0, description="Whether it is metal (1) or not (0)."
    )
    roughness: MappableNonNegative = Field(
        default=1.0, description="From mirror-like (0) to matt (1)."
    )
    occlusion: MappableNonNegative = Field(
        default=1.0, description="How much of the ambient light arrives: 0 in deep creases."
    )
    emission: MappableColor = Field(
        default=[0.0, 0.0, 0.0], description="Linear radiance the surface adds by itself."
    )
    ior: Annotated[float, Field(ge=1, le=100)] = Field(
        default=1.5, description="Index of refraction: higher reflects more where it is no metal."
    )
    specular: MappableNonNegative = Field(
        default=1.0, description="Strength of the reflection where it is no metal."
    )
    specular_color: MappableColor = Field(
        default=[1.0, 1.0, 1.0],
        description="Linear colour of the reflection seen head-on where it is no metal.",
    )
    clearcoat: MappableNonNegative = Field(
        default=0.0, description="Strength of a thin layer of varnish."
    )
    clearcoat_roughness: MappableNonNegative = Field(
        default=0.0, description="Roughness of the varnish."
    )
    energy_compensation: bool = Field(
        default=False,
        description="Give back light that bounces between microfacets: rough metal is brighter.",
    )
