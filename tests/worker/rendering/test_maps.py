"""A map in the place of a number or a colour."""

from typing import Any

import numpy as np
import pytest

from api_schemas.language import FAMILIES
from api_schemas.surface_spec import SurfaceSpec
from tests.worker.rendering.studio import Studio
from worker.images.packed_floats import packed

pytestmark = pytest.mark.gl

LIGHTS = [
    {"type": "ambient", "radiance": [0.3, 0.2, 0.1]},
    {"type": "directional", "direction": [0.3, -0.4, -1.0], "irradiance": 1.7},
    {"type": "point", "position": [0.3, 0.4, 0.9], "intensity": 0.7},
]
SPECULAR = {"specular_weight": 0.37, "emission": [0.01, 0.02, 0.03]}
OWN = [
    (technique, name)
    for technique, spec in FAMILIES["surfaces"].items()
    for name in spec.model_fields
    if name not in SurfaceSpec.model_fields
]
MAPPABLE = [
    (technique, name)
    for technique, name in OWN
    if "Mappable" in repr(FAMILIES["surfaces"][technique].model_fields[name].annotation)
]


def surface(technique: str, **values: Any) -> dict[str, Any]:
    return {"technique": technique, **(SPECULAR if technique == "phong" else {}), **values}


@pytest.mark.parametrize(("technique", "name"), OWN)
def test_every_field_of_a_surface_is_in_its_chunk(technique: str, name: str) -> None:
    from worker.rendering.shading import surface_fields  # noqa: PLC0415  needs OpenGL

    assert name in surface_fields(technique)


@pytest.mark.parametrize("filter_name", ["nearest", "bilinear", "trilinear", "anisotropic"])
@pytest.mark.parametrize("normalization", ["none", "energy"])
@pytest.mark.parametrize(("technique", "name"), MAPPABLE)
def test_a_constant_map_is_the_constant_bit_for_bit(
    studio: Studio, technique: str, name: str, filter_name: str, normalization: str
) -> None:
    # T03
    default = getattr(FAMILIES["surfaces"][technique](technique=technique).filled(), name)
    value: Any = [0.1, 0.7, 0.3] if isinstance(default, list) else 0.7
    channels = 3 if isinstance(default, list) else 1
    picture = studio.texture(np.broadcast_to(np.float32(value), (64, 64, channels)))
    mapped = {
        "texture": picture,
        "filter": filter_name,
        "transform": {"scale": [7.3, 31.0], "rotation": 0.4},
    }
    options = {"normalization": normalization} if technique == "phong" else {}

    def floor(given: Any) -> np.ndarray:
        return studio.draw(
            {
                "camera": {"type": "perspective", "pose": {"eye": [0.0, 0.3, 2.0]}},
                "lights": LIGHTS,
                "nodes": [
                    {
                        "mesh": {"type": "plane", "facing": "+y"},
                        "surface": surface(technique, **{name: given}, **options),
                    }
                ],
            },
            (64, 64),
        )

    np.testing.assert_array_equal(floor(mapped), floor(value))


def test_value_is_scale_times_texel_plus_bias(studio: Studio) -> None:
    picture = studio.texture(np.float32([[[0.5, 0.25, 0.125]]]))

    read = studio.read(picture, 0.5, 0.5, scale=3.0, bias=-0.25)

    np.testing.assert_array_equal(read[:3], [1.25, 0.5, 0.125])


def test_coordinates_are_scaled_then_turned_then_shifted(studio: Studio) -> None:
    side = 40
    transform = {"scale": [2.0, 3.0], "rotation": 0.7, "offset": [0.3, -0.4]}
    picture = studio.texture(np.random.default_rng(8).random((8, 8)))
    plain = {"technique": "unlit", "color": {"texture": picture, "filter": "nearest"}}

    drawn = studio.poster(
        {**plain, "color": {**plain["color"], "transform": transform}}, (side, side)
    )[..., 0]

    place = (np.arange(side) + 0.5) / side
    u, v = np.meshgrid(place, place[::-1])
    scaled_u, scaled_v = 2 * u, 3 * v
    turned_u = np.cos(0.7) * scaled_u - np.sin(0.7) * scaled_v + 0.3
    turned_v = np.sin(0.7) * scaled_u + np.cos(0.7) * scaled_v - 0.4
    array = studio.array(picture)[..., 0]
    expected = array[
        7 - np.floor(turned_v * 8).astype(int) % 8, np.floor(turned_u * 8).astype(int) % 8
    ]
    assert (drawn == expected).mean() > 0.995  # a texel's very edge may fall to either side


def test_equal_lookups_are_made_once_and_equal_pictures_share_a_unit(studio: Studio) -> None:
    from worker.rendering.shading import shade  # noqa: PLC0415  needs OpenGL
    from worker.rendering.textures import Texture  # noqa: PLC0415

    spec = FAMILIES["surfaces"]["phong"].model_validate(
        {
            "technique": "phong",
            "diffuse_color": {"texture": studio.texture([[0.5]])},
            "ambient_color": {"texture": studio.texture([[0.5]]), "scale": 2.0},
            "specular_color": {"texture": studio.texture([[0.5]]), "transform": {"rotation": 1.0}},
            "emission": {"texture": studio.texture([[0.5]]), "wrap": ["clamp", "clamp"]},
        }
    )
    studio.poster({"technique": "unlit"})
    texture = Texture.upload([np.ones((1, 1, 1), np.float32)], "colour")

    layout = shade(spec, lambda *_, **__: texture).layout

    assert len(layout.lookups) == 3
    assert len(layout.pictures) == 2
    texture.delete()


def test_numbers_do_not_make_new_programs(studio: Studio) -> None:
    picture = studio.texture(np.ones((4, 4, 3)))

    def draw(**how: Any) -> None:
        studio.poster({"technique": "unlit", "color": {"texture": picture, **how}})

    draw(transform={"rotation": 0.1}, scale=2.0)
    draw(transform={"offset": [3.0, 1.0]}, bias=0.5)

    assert studio.facts["jit_ms"] == 0


def test_packed_numbers_are_read_whole_and_blended_as_numbers(studio: Studio) -> None:
    # T62: a table of four numbers, looked up halfway between two of them
    table = studio.texture(packed(np.float32([[1.5, -2.25, 1000.125, 3e-20]])))
    how = {"channel": "packed", "wrap": ["clamp", "clamp"]}

    def read(u: float, filter_name: str) -> float:
        mapped = {
            "texture": table,
            "filter": filter_name,
            "transform": {"scale": [0.0, 0.0], "offset": [u, 0.5]},
            **how,
        }
        surface = {"technique": "phong", "emission": [1.0, 1.0, 1.0]}
        opacity = {"opacity": {**mapped, "scale": 1e-4, "bias": 0.5}, "alpha_mode": "blend"}
        return float(studio.poster(surface | opacity, (1, 1))[0, 0, 3])

    assert read(0.625, "nearest") == pytest.approx(0.5 + 0.1000125, abs=1e-7)
    assert read(0.5, "bilinear") == pytest.approx(0.5 + (1000.125 - 2.25) / 2e4, abs=1e-7)
