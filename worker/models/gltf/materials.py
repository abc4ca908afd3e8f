"""From glTF's materials to surfaces of our language."""

import math
from typing import Any, Final, Literal

from pydantic import ValidationError

import api_schemas.language  # noqa: F401 - it completes the models of surfaces
from api_schemas.surface_spec import SurfaceSpec
from api_schemas.surfaces.metallic_roughness import MetallicRoughnessSpec
from api_schemas.surfaces.unlit import UnlitSpec
from worker.models.gltf.document.materials import Anisotropy, Material
from worker.models.gltf.faults import unsupported
from worker.models.gltf.textures import Textures

AlphaMode = Literal["opaque", "mask", "blend"]
_ALPHA_MODES: Final[dict[str, AlphaMode]] = {"OPAQUE": "opaque", "MASK": "mask", "BLEND": "blend"}
_IOR_MAX: Final = 100.0


def surface_of(material: Material, textures: Textures, place: str) -> SurfaceSpec:
    """Say what a material means, with its factors and its textures.

    Raises:
        UnusableAssetError: A number is beyond what our surfaces take (`asset_unsupported`).
    """
    try:
        if material.extensions.unlit is not None:
            color = _base_color(material, textures)
            return UnlitSpec(technique="unlit", color=color, **_shared(material, textures))
        return _metallic_roughness(material, textures)
    except ValidationError:
        raise unsupported(place, "a number is beyond what can be drawn") from None


def _metallic_roughness(material: Material, textures: Textures) -> MetallicRoughnessSpec:
    core, more = material.pbr_metallic_roughness, material.extensions
    specular, clearcoat = more.specular, more.clearcoat
    occlusion = material.occlusion_texture
    strength = 0.0 if occlusion is None else occlusion.strength
    if clearcoat.clearcoat_factor and clearcoat.clearcoat_normal_texture is not None:
        textures.warnings.append("clearcoatNormalTexture of KHR_materials_clearcoat is ignored")
    return MetallicRoughnessSpec(
        technique="metallic_roughness",
        base_color=_base_color(material, textures),
        metallic=textures.number(core.metallic_roughness_texture, "b", core.metallic_factor),
        roughness=textures.number(core.metallic_roughness_texture, "g", core.roughness_factor),
        occlusion=textures.number(occlusion, "r", strength, 1 - strength),
        emission=textures.color(
            material.emissive_texture,
            material.emissive_factor,
            more.emissive_strength.emissive_strength,
        ),
        ior=_ior(material, textures),
        specular=textures.number(specular.specular_texture, "a", specular.specular_factor),
        specular_color=textures.color(
            specular.specular_color_texture, specular.specular_color_factor
        ),
        clearcoat=textures.number(clearcoat.clearcoat_texture, "r", clearcoat.clearcoat_factor),
        clearcoat_roughness=textures.number(
            clearcoat.clearcoat_roughness_texture, "g", clearcoat.clearcoat_roughness_factor
        ),
        normal=textures.normal(material.normal_texture),
        **_anisotropy(more.anisotropy, textures),
        **_shared(material, textures),
    )


def _anisotropy(anisotropy: Anisotropy, textures: Textures) -> dict[str, Any]:
    """Return the direction in which highlights are longer; without strength there is none."""
    strength, texture = anisotropy.anisotropy_strength, anisotropy.anisotropy_texture
    if strength == 0:
        return {}
    along = textures.number(texture, "r", 2.0, -1.0)
    up = 0.0 if isinstance(along, float) else textures.number(texture, "g", 2.0, -1.0)
    return {
        "anisotropy_strength": textures.number(texture, "b", strength),
        "anisotropy_rotation": math.remainder(anisotropy.anisotropy_rotation, math.tau),
        "anisotropy_x": along,
        "anisotropy_y": up,
    }


def _base_color(material: Material, textures: Textures) -> Any:
    core = material.pbr_metallic_roughness
    return textures.color(core.base_color_texture, core.base_color_factor[:3])


def _shared(material: Material, textures: Textures) -> dict[str, Any]:
    """Return what every surface has: opacity and sides."""
    core = material.pbr_metallic_roughness
    if material.alpha_mode not in _ALPHA_MODES:
        textures.warnings.append("an unknown alphaMode is taken as OPAQUE")
    mode = _ALPHA_MODES.get(material.alpha_mode, "opaque")
    shared: dict[str, Any] = {"alpha_mode": mode, "double_sided": material.double_sided}
    if mode == "opaque":
        return shared
    texture = core.base_color_texture if textures.has_alpha(core.base_color_texture) else None
    shared["opacity"] = textures.number(texture, "a", core.base_color_factor[3])
    if mode == "mask":
        shared["alpha_cutoff"] = min(material.alpha_cutoff, 1.0)
        if material.alpha_cutoff > 1:
            shared["opacity"] = 0.0
    return shared


def _ior(material: Material, textures: Textures) -> float:
    ior = material.extensions.ior.ior
    if ior == 0 or ior > _IOR_MAX:
        textures.warnings.append(f"an ior of KHR_materials_ior is taken as {_IOR_MAX:g}")
        return _IOR_MAX
    return ior
