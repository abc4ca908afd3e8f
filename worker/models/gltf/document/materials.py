"""Materials and the extensions of them that are read."""

from typing import Annotated, Self

from pydantic import Field, model_validator

from worker.models.gltf.document.base import (
    Fraction,
    Fractions3,
    Fractions4,
    GltfObject,
    Named,
    NonNegativeReal,
    Real,
)
from worker.models.gltf.document.pictures import (
    NormalTextureInfo,
    OcclusionTextureInfo,
    TextureInfo,
)


class MetallicRoughness(GltfObject):
    """The core model's parameters."""

    base_color_factor: Fractions4 = Field(default=[1.0, 1.0, 1.0, 1.0])
    base_color_texture: TextureInfo | None = None
    metallic_factor: Fraction = 1.0
    roughness_factor: Fraction = 1.0
    metallic_roughness_texture: TextureInfo | None = None


class EmissiveStrength(GltfObject):
    """KHR_materials_emissive_strength."""

    emissive_strength: NonNegativeReal = 1.0


class Ior(GltfObject):
    """KHR_materials_ior; 0 means a mirror of Fresnel reflectance 1."""

    ior: NonNegativeReal = 1.5

    @model_validator(mode="after")
    def _no_less_than_vacuum(self) -> Self:
        if 0 < self.ior < 1:
            raise ValueError("ior is neither 0 nor at least 1")
        return self


class Specular(GltfObject):
    """KHR_materials_specular."""

    specular_factor: Fraction = 1.0
    specular_texture: TextureInfo | None = None
    specular_color_factor: Annotated[list[NonNegativeReal], Field(min_length=3, max_length=3)] = (
        Field(default=[1.0, 1.0, 1.0])
    )
    specular_color_texture: TextureInfo | None = None


class Clearcoat(GltfObject):
    """KHR_materials_clearcoat."""

    clearcoat_factor: Fraction = 0.0
    clearcoat_texture: TextureInfo | None = None
    clearcoat_roughness_factor: Fraction = 0.0
    clearcoat_roughness_texture: TextureInfo | None = None
    clearcoat_normal_texture: NormalTextureInfo | None = None


class Anisotropy(GltfObject):
    """KHR_materials_anisotropy."""

    anisotropy_strength: Fraction = 0.0
    anisotropy_rotation: Real = 0.0
    anisotropy_texture: TextureInfo | None = None


class Unlit(GltfObject):
    """KHR_materials_unlit, which has no parameters."""


class MaterialExtensions(GltfObject):
    """The extensions of a material that are read."""

    unlit: Annotated[Unlit | None, Field(alias="KHR_materials_unlit")] = None
    emissive_strength: Annotated[
        EmissiveStrength, Field(alias="KHR_materials_emissive_strength")
    ] = EmissiveStrength()
    ior: Annotated[Ior, Field(alias="KHR_materials_ior")] = Ior()
    specular: Annotated[Specular, Field(alias="KHR_materials_specular")] = Specular()
    clearcoat: Annotated[Clearcoat, Field(alias="KHR_materials_clearcoat")] = Clearcoat()
    anisotropy: Annotated[Anisotropy, Field(alias="KHR_materials_anisotropy")] = Anisotropy()


class Material(Named):
    """How a surface looks."""

    pbr_metallic_roughness: MetallicRoughness = MetallicRoughness()
    normal_texture: NormalTextureInfo | None = None
    occlusion_texture: OcclusionTextureInfo | None = None
    emissive_texture: TextureInfo | None = None
    emissive_factor: Fractions3 = Field(default=[0.0, 0.0, 0.0])
    alpha_mode: str = "OPAQUE"
    alpha_cutoff: NonNegativeReal = 0.5
    double_sided: bool = False
    extensions: MaterialExtensions = MaterialExtensions()

    def textures(self) -> list[tuple[str, TextureInfo]]:
        """Return every reference to a texture with its place below the material."""
        core, more = self.pbr_metallic_roughness, self.extensions
        specular, clearcoat = more.specular, more.clearcoat
        places = {
            "/pbrMetallicRoughness/baseColorTexture": core.base_color_texture,
            "/pbrMetallicRoughness/metallicRoughnessTexture": core.metallic_roughness_texture,
            "/normalTexture": self.normal_texture,
            "/occlusionTexture": self.occlusion_texture,
            "/emissiveTexture": self.emissive_texture,
            "/extensions/KHR_materials_specular/specularTexture": specular.specular_texture,
            "/extensions/KHR_materials_specular/specularColorTexture": (
                specular.specular_color_texture
            ),
            "/extensions/KHR_materials_clearcoat/clearcoatTexture": clearcoat.clearcoat_texture,
            "/extensions/KHR_materials_clearcoat/clearcoatRoughnessTexture": (
                clearcoat.clearcoat_roughness_texture
            ),
            "/extensions/KHR_materials_clearcoat/clearcoatNormalTexture": (
                clearcoat.clearcoat_normal_texture
            ),
            "/extensions/KHR_materials_anisotropy/anisotropyTexture": (
                more.anisotropy.anisotropy_texture
            ),
        }
        return [(place, info) for place, info in places.items() if info is not None]
