"""What is told of environments before work starts: their shape, their maps and their cost."""

from typing import Any

import pytest

from api_schemas.asset_use import misuses
from api_schemas.assets import ASSET_FACTS, AssetFacts
from api_schemas.estimate import estimate
from api_schemas.feasibility import obstacles
from api_schemas.own_size import size_within
from api_schemas.requests import RenderRequest, TextureRequest

ASSET = "0" * 64
PICTURE = {"technique": "image", "asset": ASSET}


def facts(width: int, height: int) -> dict[str, AssetFacts]:
    known = {
        "kind": "image",
        "sha256": ASSET,
        "bytes": 1000,
        "media_type": "image/x-exr",
        "width": width,
        "height": height,
        "channels": 3,
        "format": "openexr",
        "bits": 16,
        "has_alpha": False,
        "float": True,
    }
    return {ASSET: ASSET_FACTS.validate_python(known)}


def scene(environment: dict[str, Any] | None = None, **node: Any) -> RenderRequest:
    nodes = [{"mesh": {"type": "sphere"}, **node}]
    body: dict[str, Any] = {"scene": {"nodes": nodes}, "output": {"size": [64, 64]}}
    if environment is not None:
        body["scene"]["environment"] = environment
    return RenderRequest.model_validate(body)


@pytest.mark.parametrize(
    ("layout", "good", "bad"),
    [
        ({"technique": "latlong"}, (512, 256), (512, 512)),
        ({"technique": "cube"}, (64, 384), (64, 320)),  # five faces
        ({"technique": "cube", "arrangement": "cross"}, (256, 192), (192, 256)),
        ({"technique": "angular_probe"}, (100, 100), (100, 99)),
    ],
)
def test_a_picture_has_the_shape_of_its_layout(
    layout: dict[str, Any], good: tuple[int, int], bad: tuple[int, int]
) -> None:
    rendered = scene({"texture": PICTURE, "layout": layout})
    converted = TextureRequest.model_validate(
        {
            "texture": {"technique": "convert_layout", "environment": PICTURE, "layout": layout},
            "output": {"size": [64, 32]},
        }
    )

    for request, pointer in (
        (rendered, "/scene/environment/texture/asset"),
        (converted, "/texture/environment/asset"),
    ):
        assert not list(misuses(request, facts(*good)))
        found = list(misuses(request, facts(*bad)))
        assert [(o.code, o.pointer) for o in found] == [("layout_mismatch", pointer)]
        assert f"{bad[0]} x {bad[1]}" in found[0].message


def test_an_environment_takes_the_room_of_three_maps() -> None:
    # A surface has nowhere near so many parameters but in a map of surfaces: the count is by part.
    assert not obstacles(scene({"texture": PICTURE}))


def test_environments_and_surroundings_cost() -> None:
    plain = estimate(scene(), facts(256, 128))
    lit = estimate(scene({"texture": PICTURE}), facts(256, 128))
    mirrored = estimate(scene({"texture": PICTURE}, surroundings={"side": 512}), facts(256, 128))

    assert lit.seconds > plain.seconds + 1
    discs = {"side": 512, "layout": "hemispheres"}
    on_discs = estimate(scene({"texture": PICTURE}, surroundings=discs), facts(256, 128))
    assert on_discs.seconds > mirrored.seconds + 1
    assert mirrored.seconds > lit.seconds + 1
    assert mirrored.bytes > lit.bytes > plain.bytes


def test_a_huge_picture_in_another_layout_is_weighed() -> None:
    body = {
        "texture": {"technique": "prefiltered_environment", "environment": PICTURE},
        "output": {"size": [16384, 8192]},
    }

    cost = estimate(TextureRequest.model_validate(body), facts(512, 256))

    assert cost.seconds > 60


@pytest.mark.parametrize(
    ("brushed", "plain"),
    [
        ({"technique": "ward"}, {"technique": "phong"}),
        (
            {"technique": "metallic_roughness", "anisotropy_strength": {"texture": PICTURE}},
            {"technique": "metallic_roughness", "anisotropy_rotation": {"texture": PICTURE}},
        ),
        (
            {
                "technique": "metallic_roughness",
                "height": {"texture": PICTURE, "fine_detail": "streaks"},
            },
            {
                "technique": "metallic_roughness",
                "height": {"texture": PICTURE, "fine_detail": "roughness"},
            },
        ),
    ],
)
def test_a_streak_of_sky_costs_as_many_mirrors(
    brushed: dict[str, Any], plain: dict[str, Any]
) -> None:
    # A dozen readings of a cube and a picture for each of 4096 x 4096 pixels are no milliseconds.
    def seconds(surface: dict[str, Any], environment: dict[str, Any] | None) -> float:
        body = scene(environment, surface=surface).model_dump()
        body["output"]["size"] = [4096, 4096]
        return estimate(RenderRequest.model_validate(body), facts(512, 256)).seconds

    sky = {"texture": PICTURE}
    assert seconds(brushed, sky) > seconds(plain, sky) + 1
    assert seconds(brushed, None) < seconds(plain, None) + 0.1  # tangents are made once


FACES = ("front", "right", "back", "left", "top", "bottom")


def six(**more: Any) -> dict[str, Any]:
    return {"technique": "six_faces", **dict.fromkeys(FACES, PICTURE), **more}


def test_a_face_of_a_cube_is_square() -> None:
    request = scene({"texture": six(), "layout": {"technique": "cube"}})

    assert not list(misuses(request, facts(64, 64)))
    found = list(misuses(request, facts(64, 63)))
    assert [(o.code, o.pointer) for o in found] == [
        ("layout_mismatch", f"/scene/environment/texture/{face}/asset") for face in FACES
    ]


@pytest.mark.parametrize(
    ("layout", "arrangement", "good"),
    [
        ({"technique": "cube"}, "column", True),
        ({"technique": "cube", "arrangement": "cross"}, "cross", True),
        ({"technique": "cube", "arrangement": "cross"}, "column", False),
        ({"technique": "cube", "orientation": "gl"}, "column", False),
        ({"technique": "latlong"}, "column", False),
    ],
)
def test_six_faces_are_read_as_they_lie(
    layout: dict[str, Any], arrangement: str, good: bool
) -> None:
    request = scene({"texture": six(arrangement=arrangement), "layout": layout})

    found = [(o.code, o.pointer) for o in misuses(request, facts(64, 64))]

    assert found == ([] if good else [("layout_mismatch", "/scene/environment/layout")])


@pytest.mark.parametrize("arrangement", ["column", "row", "cross", "tall_cross"])
def test_six_faces_keep_their_own_pixels(arrangement: str) -> None:
    request = TextureRequest.model_validate(
        {"texture": {"technique": "convert_layout", "environment": six(arrangement=arrangement)}}
    )

    size = size_within(request.texture, "environment", (8, 4), lambda picture: (300, 300))

    columns, rows = {"column": (1, 6), "row": (6, 1), "cross": (4, 3), "tall_cross": (3, 4)}[
        arrangement
    ]
    assert size == (300 * columns, 300 * rows)


def test_a_sky_that_is_added_up_costs_a_thousand_lamps_a_sample() -> None:
    def seconds(gathered: str) -> float:
        body = scene({"texture": PICTURE, "gathered": gathered}).model_dump()
        body["output"]["size"] = [1024, 1024]
        return estimate(RenderRequest.model_validate(body), facts(512, 256)).seconds

    # A framed ball fills a third of a million pixels at least.
    assert seconds("sum") > seconds("prefiltered") + 0.3 * 2**20 * 1536 * 5e-8
