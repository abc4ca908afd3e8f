"""Materials as surfaces, after glTF 2.0, section 3.9, and the extensions' own texts."""

import hashlib
import math
from typing import Any

import numpy as np
import pytest

from api_schemas.maps import ColorMap, NormalMap, NumberMap, TextureTransform
from api_schemas.surfaces.metallic_roughness import MetallicRoughnessSpec
from api_schemas.surfaces.unlit import UnlitSpec
from tests.worker.geometry.gltf.building import Builder, data_uri, png, shown
from worker.errors import UnusableAssetError
from worker.geometry.gltf.reader import read
from worker.geometry.model import Model

OPAQUE, CLEAR = png(), png(alpha=True)
DIGEST = {content: hashlib.sha256(content).hexdigest() for content in (OPAQUE, CLEAR)}
FULL_TURN = 2 * math.pi


def model_of(material: dict[str, Any] | None, picture: bytes = CLEAR, **members: Any) -> Model:
    builder = Builder(**members)
    builder.add("images", {"uri": data_uri(picture, "image/png")})
    builder.json.setdefault("textures", [{"source": 0}])
    sets = {f"TEXCOORD_{n}": builder.accessor([[0, 0]] * 3) for n in range(3)}
    worn = {}
    if material is not None:
        worn["material"] = builder.add("materials", material)
    builder.mesh(attributes=sets, **worn)
    builder.json |= shown(0)
    if material is not None:
        used = sorted(_extensions(material))
        if used:
            builder.json["extensionsUsed"] = used
    return read(builder.glb(), {})


def _extensions(value: Any) -> set[str]:
    if isinstance(value, list):
        return set().union(*map(_extensions, value))
    if not isinstance(value, dict):
        return set()
    inner = set().union(set(), *map(_extensions, value.values()))
    return inner | set(value.get("extensions", {}))


def surface_of(material: dict[str, Any] | None, **members: Any) -> Any:
    return model_of(material, **members).surfaces[0].surface


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
            },
        }
    )

    assert surface.base_color == [0.1, 0.2, 0.3]
    assert (surface.metallic, surface.roughness) == (0.5, 0.6)
    assert surface.emission == [1, 2, 4]
    assert surface.double_sided
    assert (surface.ior, surface.specular, surface.specular_color) == (1.25, 0.75, [0.5, 1, 2])
    assert (surface.clearcoat, surface.clearcoat_roughness) == (0.5, 0.2)
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
            },
        }
    )
    surface: Any = model.surfaces[0].surface

    def color(value: Any) -> tuple[str, str, list[float], float]:
        assert isinstance(value, ColorMap)
        image: Any = value.texture
        assert image.asset == DIGEST[CLEAR]
        return image.encoding, image.alpha, value.tint, value.scale

    def number(value: Any) -> tuple[str, float, float]:
        assert isinstance(value, NumberMap)
        image: Any = value.texture
        assert image.asset == DIGEST[CLEAR]
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
    assert isinstance(surface.normal, NormalMap)
    assert (surface.normal.strength, surface.normal.green) == (0.7, "up")
    assert surface.normal.range == "unit"
    assert surface.normal.texture.encoding == "linear"
    assert model.pictures == {DIGEST[CLEAR]: CLEAR}
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

    assert surface_of(material, picture=OPAQUE).opacity == 0.4
    for picture in (CLEAR, png(transparent=True)):
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


@pytest.mark.parametrize(
    ("sampler", "wrap", "filter_"),
    [
        (None, ["repeat", "repeat"], "anisotropic"),
        ({}, ["repeat", "repeat"], "anisotropic"),
        ({"wrapS": 33071, "wrapT": 33648}, ["clamp", "mirror"], "anisotropic"),
        ({"magFilter": 9728}, ["repeat", "repeat"], "nearest"),
        ({"magFilter": 9728, "minFilter": 9987}, ["repeat", "repeat"], "nearest"),
        ({"magFilter": 9729, "minFilter": 9729}, ["repeat", "repeat"], "bilinear"),
        ({"magFilter": 9729, "minFilter": 9987}, ["repeat", "repeat"], "anisotropic"),
    ],
)
def test_samplers_decide_what_lies_beyond_and_between_texels(
    sampler: dict[str, int] | None, wrap: list[str], filter_: str
) -> None:
    members: dict[str, Any] = {"textures": [{"source": 0}]}
    if sampler is not None:
        members = {"textures": [{"source": 0, "sampler": 0}], "samplers": [sampler]}
    surface = surface_of({"emissiveTexture": {"index": 0}}, **members)

    assert surface.emission.wrap == wrap
    assert surface.emission.filter == filter_


def test_unknown_words_and_numbers_are_told_and_taken_as_the_default() -> None:
    model = model_of(
        {"emissiveTexture": {"index": 0}, "alphaMode": "GLASS"},
        textures=[{"source": 0, "sampler": 0}],
        samplers=[{"wrapS": 1, "magFilter": 2}],
    )

    assert len(model.warnings) == 3
    assert "GLASS" not in "".join(model.warnings)
    assert model.surfaces[0].surface.alpha_mode == "opaque"


def spec_transform(uv: np.ndarray, offset: Any, turn: float, scale: Any) -> np.ndarray:
    """KHR_texture_transform by its text: scaled, turned counter-clockwise as seen, then moved.

    The picture's v runs down, so counter-clockwise takes (1, 0) to (cos, -sin).
    """
    u, v = uv[:, 0] * scale[0], uv[:, 1] * scale[1]
    cosine, sine = math.cos(turn), math.sin(turn)
    return np.stack([cosine * u + sine * v + offset[0], cosine * v - sine * u + offset[1]], axis=1)


def our_transform(uv: np.ndarray, transform: TextureTransform) -> np.ndarray:
    """As our own documentation says: scaled, turned counter-clockwise, shifted, with v up."""
    u, v = uv[:, 0] * transform.scale[0], uv[:, 1] * transform.scale[1]
    cosine, sine = math.cos(transform.rotation), math.sin(transform.rotation)
    turned = np.stack([cosine * u - sine * v, sine * u + cosine * v], axis=1)
    return turned + transform.offset


def transform_of(extension: dict[str, Any]) -> Any:
    info = {"index": 0, "extensions": {"KHR_texture_transform": extension}}
    return surface_of({"emissiveTexture": info}).emission


@pytest.mark.parametrize(
    ("offset", "turn", "scale"),
    [
        ([0, 0], 0, [1, 1]),
        ([0.25, -0.5], 0, [1, 1]),
        ([0, 0], 0.7, [1, 1]),
        ([0, 0], 0, [2, -3]),
        ([0.3, 0.4], -2.5, [0.5, 3]),
        ([0.3, 0.4], 100.0, [0.5, 3]),
    ],
)
def test_a_texture_transform_reads_the_same_texels_with_v_up(
    offset: list[float], turn: float, scale: list[float]
) -> None:
    uv_down = np.array([[0, 0], [1, 0], [0, 1], [0.3, 0.8]])
    uv_up = np.stack([uv_down[:, 0], 1 - uv_down[:, 1]], axis=1)

    mapped = transform_of({"offset": offset, "rotation": turn, "scale": scale})

    expected = spec_transform(uv_down, offset, turn, scale)
    found = our_transform(uv_up, mapped.transform)
    assert found[:, 0] == pytest.approx(expected[:, 0], abs=1e-12)
    assert 1 - found[:, 1] == pytest.approx(expected[:, 1], abs=1e-12)


def test_the_example_of_the_extension_shows_the_lower_left_quadrant() -> None:
    """The text says so of offset (0, 1), a quarter turn and scale 1/2."""
    corners = np.array([[0, 0], [1, 0], [0, 1], [1, 1]])

    mapped = transform_of({"offset": [0, 1], "rotation": FULL_TURN / 4, "scale": [0.5, 0.5]})

    read_at = our_transform(corners, mapped.transform)
    assert read_at.min(axis=0) == pytest.approx([0, 0], abs=1e-12)
    assert read_at.max(axis=0) == pytest.approx([0.5, 0.5], abs=1e-12)


def test_the_transform_may_choose_another_set_of_coordinates() -> None:
    info = {"index": 0, "texCoord": 1}
    plain: Any = surface_of({"emissiveTexture": info})
    other = {**info, "extensions": {"KHR_texture_transform": {"texCoord": 2}}}

    assert plain.emission.coordinates.set == 1
    assert surface_of({"emissiveTexture": other}).emission.coordinates.set == 2


def test_a_texture_that_needs_coordinates_the_mesh_lacks_is_refused() -> None:
    with pytest.raises(UnusableAssetError, match="emissiveTexture needs TEXCOORD_3"):
        model_of({"emissiveTexture": {"index": 0, "texCoord": 3}})


@pytest.mark.parametrize(
    "name",
    [
        "KHR_materials_sheen",
        "KHR_materials_transmission",
        "KHR_materials_volume",
        "KHR_materials_iridescence",
        "KHR_materials_anisotropy",
        "KHR_materials_dispersion",
        "KHR_materials_pbrSpecularGlossiness",
        "VENDOR_whatever",
    ],
)
def test_what_is_not_drawn_is_named(name: str) -> None:
    model = model_of({"extensions": {name: {"anything": [1]}}})

    assert model.warnings == (f"the extension {name} is ignored",)


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
    ],
)
def test_numbers_that_gltf_forbids_are_refused(material: dict[str, Any], word: str) -> None:
    with pytest.raises(UnusableAssetError, match=word):
        model_of(material)


def test_numbers_beyond_what_is_drawn_are_unsupported() -> None:
    with pytest.raises(UnusableAssetError) as caught:
        transform_of({"offset": [1e30, 0]})

    assert caught.value.code == "asset_unsupported"
    assert caught.value.message.startswith("/materials/0: ")


@pytest.mark.parametrize(
    ("required", "code"),
    [
        ("KHR_draco_mesh_compression", "asset_unsupported"),
        ("EXT_meshopt_compression", "asset_unsupported"),
        ("KHR_texture_basisu", "asset_unsupported"),
        ("EXT_texture_webp", "asset_unsupported"),
        ("KHR_materials_sheen", "asset_unsupported"),
    ],
)
def test_what_a_file_requires_and_is_not_read_is_refused_by_name(required: str, code: str) -> None:
    names = {"extensionsUsed": [required], "extensionsRequired": [required]}
    with pytest.raises(UnusableAssetError, match=required) as caught:
        model_of({}, **names)

    assert caught.value.code == code


@pytest.mark.parametrize(
    ("members", "word"),
    [
        ({"extensionsRequired": ["KHR_materials_unlit"]}, "not in extensionsUsed"),
        ({"materials": [{"extensions": {"KHR_materials_unlit": {}}}]}, "not in extensionsUsed"),
        (
            {
                "materials": [{"extensions": {"KHR_texture_transform": {}}}],
                "extensionsUsed": ["KHR_texture_transform"],
            },
            "/materials/0: KHR_texture_transform cannot stand here",
        ),
        ({"extensionsUsed": ["A_b", "A_b"]}, "equal"),
        ({"extensionsRequired": ["<b>x</b>"], "extensionsUsed": ["<b>x</b>"]}, r"extension \? is"),
    ],
)
def test_extensions_that_are_not_declared_or_stand_wrong_are_refused(
    members: dict[str, Any], word: str
) -> None:
    with pytest.raises(UnusableAssetError, match=word):
        read(Builder(**members).gltf(), {})


def test_extras_may_hold_anything() -> None:
    extras = {"extensions": {"FAKE_x": None}, "deep": [[[{"extensions": 7}]]], "nothing": None}

    assert read(Builder(extras=extras, nodes=[{"extras": None}]).gltf(), {}).warnings == ()
