"""How textures are looked up: samplers, transforms and sets of coordinates."""

import math
from typing import Any

import numpy as np
import pytest

from api_schemas.maps import TextureTransform
from tests.worker.models.gltf.dressing import model_of, surface_of
from worker.errors import UnusableAssetError

FULL_TURN = 2 * math.pi


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


def test_numbers_beyond_what_is_drawn_are_unsupported() -> None:
    with pytest.raises(UnusableAssetError) as caught:
        transform_of({"offset": [1e30, 0]})

    assert caught.value.code == "asset_unsupported"
    assert caught.value.message.startswith("/materials/0: ")
