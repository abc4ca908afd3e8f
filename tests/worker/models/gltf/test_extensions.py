"""Extensions: read, named as ignored, or refused by name."""

from typing import Any

import pytest

from tests.worker.models.gltf.building import Builder
from tests.worker.models.gltf.dressing import model_of
from worker.errors import UnusableAssetError
from worker.models.gltf.reader import read


@pytest.mark.parametrize(
    "name",
    [
        "KHR_materials_sheen",
        "KHR_materials_transmission",
        "KHR_materials_volume",
        "KHR_materials_iridescence",
        "KHR_materials_dispersion",
        "KHR_materials_pbrSpecularGlossiness",
        "VENDOR_whatever",
    ],
)
def test_what_is_not_drawn_is_named(name: str) -> None:
    model = model_of({"extensions": {name: {"anything": [1]}}})

    assert model.warnings == (f"the extension {name} is ignored",)


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
