"""Materials as surfaces, after glTF 2.0, section 3.9, and the extensions' own texts."""

import hashlib
from typing import Any

import pytest

from api_schemas.maps import ColorMap, NormalMap, NumberMap
from api_schemas.surfaces.metallic_roughness import MetallicRoughnessSpec
from api_schemas.surfaces.unlit import UnlitSpec
from tests.worker.models.gltf.building import Builder, png
from tests.worker.models.gltf.dressing import TRANSLUCENT, model_of, surface_of
from worker.errors import UnusableAssetError
from worker.models.gltf.reader import read

DIGEST = hashlib.sha256(TRANSLUCENT).hexdigest()


def test_a_mesh_without_material_gets_the_default_one() -> None:
    model = model_of(None)

    assert model.parts[0].material == 0
    assert model.surfaces[0].surface == MetallicRoughnessSpec(
        technique="metallic_roughness",
        base_color=[1, 1, 1],
        metallic=1,
        roughness=1,
        emission=[0, 0, 0],
        alpha_mode="opaque",
        double_sided=False,
    )
    assert model.surfaces[0].surface == surface_of({})


def test_the_default_material_comes_after_those_of_the_file() -> None:
    builder = Builder(materials=[{"name": "red"}, {"name": "blue"}])
    builder.mesh(material=1)
    builder.mesh()
    builder.json["nodes"] = [{"mesh": 0}, {"mesh": 1}]
    model = read(builder.glb(), {})

    assert [part.material for part in model.parts] == [1, 2]
    assert [surface.name for surface in model.surfaces] == ["red", "blue", ""]


def test_factors_without_textures_are_plain_values() -> None:
    surface = surface_of(
        {
            "pbrMetallicRoughness": {
                "baseColorFactor": [0.1, 0.2, 0.3, 0.4],
                "metallicFactor": 0.5,
                "roughnessFactor": 0.6,
            },
            "emissiveFactor": [0.25, 0.5, 1],
            "doubleSided": True,
            "extensions": {
                "KHR_materials_emissive_strength": {"emissiveStrength": 4},
                "KHR_materials_ior": {"ior": 1.25},
                "KHR_materials_specular": {
                    "specularFactor": 0.75,
                    "specularColorFactor": [0.5, 1, 2],
                },
                "KHR_materials_clearcoat": {
                    "clearcoatFactor": 0.5,
                    "clearcoatRoughnessFactor": 0.2,
                },
                "KHR_materials_anisotropy": {
                    "anisotropyStrength": 0.4,
                    "anisotropyRotation": 1.5,
                },
            },
        }
    )

    assert surface.base_color == [0.1, 0.2, 0.3]
    assert (surface.metallic, surface.roughness) == (0.5, 0.6)
    assert surface.emission == [1, 2, 4]
    assert surface.double_sided
    assert (surface.ior, surface.specular, surface.specular_color) == (1.25, 0.75, [0.5, 1, 2])
    assert (surface.clearcoat, surface.clearcoat_roughness) == (0.5, 0.2)
    assert (surface.anisotropy_strength, surface.anisotropy_rotation) == (0.4, 1.5)
    assert (surface.anisotropy_x, surface.anisotropy_y) == (1, 0)
    assert (surface.occlusion, surface.normal, surface.opacity) == (1, None, 1)


def test_each_texture_is_read_from_its_channels_in_its_encoding() -> None:
    info = {"index": 0}
    model = model_of(
        {
            "pbrMetallicRoughness": {
                "baseColorFactor": [0.1, 0.2, 0.3, 0.4],
                "baseColorTexture": info,
                "metallicFactor": 0.5,
                "roughnessFactor": 0.6,
                "metallicRoughnessTexture": info,
            },
            "normalTexture": {**info, "scale": 0.7},
            "occlusionTexture": {**info, "strength": 0.25},
            "emissiveTexture": info,
            "emissiveFactor": [1, 0.5, 0],
            "alphaMode": "BLEND",
            "extensions": {
                "KHR_materials_emissive_strength": {"emissiveStrength": 4},
                "KHR_materials_specular": {
                    "specularFactor": 0.75,
                    "specularTexture": info,
                    "specularColorTexture": info,
                },
                "KHR_materials_clearcoat": {
                    "clearcoatFactor": 0.5,
                    "clearcoatTexture": info,
                    "clearcoatRoughnessFactor": 0.2,
                    "clearcoatRoughnessTexture": info,
                },
                "KHR_materials_anisotropy": {
                    "anisotropyStrength": 0.3,
                    "anisotropyTexture": info,
                },
            },
        }
    )
    surface: Any = model.surfaces[0].surface

    def color(value: Any) -> tuple[str, str, list[float], float]:
        assert isinstance(value, ColorMap)
        image: Any = value.texture
        assert image.asset == DIGEST
        return image.encoding, image.alpha, value.tint, value.scale

    def number(value: Any) -> tuple[str, float, float]:
        assert isinstance(value, NumberMap)
        image: Any = value.texture
        assert image.asset == DIGEST
        assert (image.encoding, image.alpha) == (
            "linear",
            "use" if value.channel == "a" else "ignore",
        )
        return value.channel, value.scale, value.bias

    assert color(surface.base_color) == ("srgb", "ignore", [0.1, 0.2, 0.3], 1)
    assert color(surface.emission) == ("srgb", "ignore", [1, 0.5, 0], 4)
    assert color(surface.specular_color) == ("srgb", "ignore", [1, 1, 1], 1)
    assert number(surface.opacity) == ("a", 0.4, 0)
    assert number(surface.metallic) == ("b", 0.5, 0)
    assert number(surface.roughness) == ("g", 0.6, 0)
    assert number(surface.occlusion) == ("r", 0.25, 0.75)
    assert number(surface.specular) == ("a", 0.75, 0)
    assert number(surface.clearcoat) == ("r", 0.5, 0)
    assert number(surface.clearcoat_roughness) == ("g", 0.2, 0)
    assert number(surface.anisotropy_strength) == ("b", 0.3, 0)
    assert number(surface.anisotropy_x) == ("r", 2, -1)
    assert number(surface.anisotropy_y) == ("g", 2, -1)
    assert isinstance(surface.normal, NormalMap)
    assert (surface.normal.strength, surface.normal.green) == (0.7, "up")
    assert surface.normal.range == "unit"
    assert surface.normal.texture.encoding == "linear"
    assert model.pictures == {DIGEST: TRANSLUCENT}
    assert model.warnings == ()


@pytest.mark.parametrize(
    ("material", "mode", "opacity", "cutoff"),
    [
        ({}, "opaque", 1, 0.5),
        ({"alphaMode": "OPAQUE", "alphaCutoff": 0.3}, "opaque", 1, 0.5),
        ({"alphaMode": "MASK"}, "mask", 0.4, 0.5),
        ({"alphaMode": "MASK", "alphaCutoff": 0.3}, "mask", 0.4, 0.3),
        ({"alphaMode": "MASK", "alphaCutoff": 1.5}, "mask", 0, 1),
        ({"alphaMode": "BLEND"}, "blend", 0.4, 0.5),
    ],
)
def test_alpha_is_opacity_where_the_mode_asks_for_it(
    material: dict[str, Any], mode: str, opacity: float, cutoff: float
) -> None:
    core = {"baseColorFactor": [1, 1, 1, 0.4]}
    surface = surface_of({"pbrMetallicRoughness": core, **material})

    assert (surface.alpha_mode, surface.opacity, surface.alpha_cutoff) == (mode, opacity, cutoff)


def test_a_picture_without_alpha_leaves_opacity_to_the_factor() -> None:
    core = {"baseColorFactor": [1, 1, 1, 0.4], "baseColorTexture": {"index": 0}}
    material = {"pbrMetallicRoughness": core, "alphaMode": "BLEND"}

    assert surface_of(material, picture=png()).opacity == 0.4
    for picture in (TRANSLUCENT, png(transparent=True)):
        assert isinstance(surface_of(material, picture=picture).opacity, NumberMap)


def test_unlit_shows_the_base_colour_and_keeps_opacity_and_sides() -> None:
    surface = surface_of(
        {
            "pbrMetallicRoughness": {"baseColorFactor": [0.1, 0.2, 0.3, 0.4]},
            "emissiveFactor": [1, 1, 1],
            "alphaMode": "BLEND",
            "extensions": {"KHR_materials_unlit": {}},
        }
    )

    assert surface == UnlitSpec(
        technique="unlit",
        color=[0.1, 0.2, 0.3],
        opacity=0.4,
        alpha_mode="blend",
        double_sided=False,
    )


def test_the_normal_map_of_a_coat_and_extreme_refraction_are_named() -> None:
    coat = {"clearcoatFactor": 1, "clearcoatNormalTexture": {"index": 0}}
    mirror = {"ior": 0}
    model = model_of({"extensions": {"KHR_materials_clearcoat": coat, "KHR_materials_ior": mirror}})

    assert any("clearcoatNormalTexture" in warning for warning in model.warnings)
    assert any("KHR_materials_ior" in warning for warning in model.warnings)


@pytest.mark.parametrize(
    ("material", "word"),
    [
        ({"pbrMetallicRoughness": {"metallicFactor": 1.1}}, "less than or equal to 1"),
        ({"pbrMetallicRoughness": {"baseColorFactor": [1, 1, 1]}}, "at least 4"),
        ({"emissiveFactor": [2, 0, 0]}, "less than or equal to 1"),
        ({"alphaCutoff": -1}, "greater than or equal to 0"),
        ({"doubleSided": 1}, "boolean"),
        ({"normalTexture": {"scale": 1}}, "/materials/0/normalTexture/index: field required"),
        (
            {"normalTexture": {"index": 1}},
            "normalTexture/index: index 1 is not below 1",
        ),
        ({"occlusionTexture": {"index": 0, "strength": 2}}, "less than or equal to 1"),
        ({"extensions": {"KHR_materials_ior": {"ior": 0.5}}}, "neither 0 nor at least 1"),
        ({"extensions": {"KHR_materials_specular": {"specularFactor": -1}}}, "greater than"),
        ({"extensions": {"KHR_materials_anisotropy": {"anisotropyStrength": 2}}}, "less than"),
        (
            {"extensions": {"KHR_materials_anisotropy": {"anisotropyTexture": {"index": 5}}}},
            "anisotropyTexture/index: index 5 is not below 1",
        ),
    ],
)
def test_numbers_that_gltf_forbids_are_refused(material: dict[str, Any], word: str) -> None:
    with pytest.raises(UnusableAssetError, match=word):
        model_of(material)
