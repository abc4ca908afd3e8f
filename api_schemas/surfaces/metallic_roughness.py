"""The surface of glTF 2.0."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, ClassVar, Literal

from pydantic import Field

from api_schemas.families import SurfaceSpec

if TYPE_CHECKING:
    from api_schemas.language import MappableColor, MappableNonNegative


class MetallicRoughnessSpec(SurfaceSpec):
    """The surface of glTF 2.0: microfacets of metal, or of a dielectric over a matt base; varnish.

    Ambient light counts as a uniform sky. Colours of the mesh's vertices multiply base_color.
    """

    source: ClassVar[str] = (
        "Khronos, glTF 2.0, appendix B, 2021, with KHR_materials_ior, _specular and _clearcoat; "
        "Walter et al., 2007; Heitz, 2014; Karis, 2013 (sky); Turquin, 2019 (energy)"
    )
    equation: ClassVar[str] = (
        "f = mix((1 - F) c / pi + F D V, Fm D V, metallic), alpha = roughness^2, "
        "F = F0 + (specular - F0) (1 - v.h)^5, "
        "F0 = specular specular_color ((ior - 1) / (ior + 1))^2, Fm = c + (1 - c) (1 - v.h)^5, "
        "D of GGX, V = G / (4 n.l n.v) of height-correlated Smith"
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
        default=1.0, description="How wide highlights are, from mirror-like (0) to dull (1)."
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
