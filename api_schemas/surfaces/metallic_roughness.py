"""The surface of glTF 2.0."""

from __future__ import annotations

from typing import Annotated, ClassVar, Literal

from pydantic import Field

from api_schemas.maps import MappableColor, MappableNonNegative, MappableNumber
from api_schemas.surface_spec import STREAK_LOOKUPS, SurfaceSpec


class MetallicRoughnessSpec(SurfaceSpec):
    """The surface of glTF 2.0: microfacets of metal, or of a dielectric over a matt base; varnish.

    Ambient light counts as a uniform sky. Colours of the mesh's vertices multiply base_color.
    """

    revision: ClassVar[int] = 2
    streaks: ClassVar[bool] = True
    sums_sky: ClassVar[bool] = True
    source: ClassVar[str] = (
        "Khronos, glTF 2.0, appendix B, 2021, with KHR_materials_ior, _specular, _clearcoat and "
        "_anisotropy; Walter et al., 2007; Burley, 2012; Heitz, 2014; Karis, 2013 (sky); Turquin, "
        "2019 (energy)"
    )
    equation: ClassVar[str] = (
        "f = mix((1 - F) c / pi + F D V, Fm D V, metallic), alpha = roughness^2, "
        "F = F0 + (specular - F0) (1 - v.h)^5, "
        "F0 = specular specular_color ((ior - 1) / (ior + 1))^2, Fm = c + (1 - c) (1 - v.h)^5, "
        "D of GGX, V = G / (4 n.l n.v) of height-correlated Smith, "
        "alpha_t = mix(alpha, 1, anisotropy_strength^2), alpha_b = alpha"
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
    anisotropy_strength: MappableNonNegative = Field(
        default=0.0,
        description="How much longer highlights are along one direction than across it, as on "
        "brushed metal: from as they are (0) to as dull as can be (1) along it.",
    )
    anisotropy_rotation: MappableNumber = Field(
        default=0.0,
        description="Turns that direction counter-clockwise, in radians, from where u grows.",
    )
    anisotropy_x: MappableNumber = Field(
        default=1.0,
        description="The part of that direction along u, before it is turned: mapped together with "
        "anisotropy_y, which may be another channel, it is as long as it likes.",
    )
    anisotropy_y: MappableNumber = Field(
        default=0.0, description="The part of that direction along v."
    )
    energy_compensation: bool = Field(
        default=False,
        description="Give back light that bounces between microfacets: rough metal is brighter.",
    )

    @property
    def needs_tangents(self) -> bool:
        """Highlights that are longer in one direction need it; a map may make them so."""
        return self.anisotropy_strength != 0

    @property
    def sky_lookups(self) -> int:
        """A streak is as many mirrors."""
        return STREAK_LOOKUPS if self.is_streaked else 1
