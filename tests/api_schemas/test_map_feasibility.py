"""Maps that cannot be looked up are named before any work starts."""

import pytest

from api_schemas.asset_use import misuses
from api_schemas.assets import ImageFacts
from api_schemas.estimate import estimate
from api_schemas.feasibility import obstacles
from api_schemas.map_feasibility import FORMULAS_MAX
from api_schemas.requests import RenderRequest

ASSET = "0" * 64
AT = "/scene/nodes/0/surface/color"
PERLIN = {"technique": "perlin"}
REFLECTION = {"technique": "reflection"}


def request(color, **output):
    surface = {"technique": "unlit", "color": {"texture": PERLIN, **color}}
    node = {"mesh": {"type": "plane"}, "surface": surface}
    return RenderRequest.model_validate({"scene": {"nodes": [node]}, "output": output})


def found(color):
    return [(obstacle.code, obstacle.pointer) for obstacle in obstacles(request(color))]


@pytest.mark.parametrize(
    ("color", "code", "pointer"),
    [
        ({"layout": {"technique": "latlong"}}, "layout_without_direction", "/layout"),
        (
            {"layout": {"technique": "latlong"}, "coordinates": {"technique": "triplanar"}},
            "layout_without_direction",
            "/layout",
        ),
        (
            {
                "layout": {"technique": "fisheye", "model": "orthographic", "angle": 4.0},
                "coordinates": REFLECTION,
            },
            "layout_impossible",
            "/layout/angle",
        ),
        (
            {
                "layout": {"technique": "cube"},
                "coordinates": REFLECTION,
                "transform": {"scale": [2.0, 1.0]},
            },
            "layout_impossible",
            "/transform",
        ),
        (
            {"layout": {"technique": "cube"}, "coordinates": REFLECTION, "filter": "formula"},
            "formula_missing",
            "/filter",
        ),
        (
            {"texture": {"technique": "wavelet"}, "filter": "formula"},
            "formula_missing",
            "/texture",
        ),
        (
            {
                "texture": {
                    "technique": "ramp",
                    "input": {"technique": "perlin", "output": "slope"},
                    "stops": [{"position": 0.5, "color": [1, 1, 1]}],
                },
                "filter": "formula",
            },
            "formula_missing",
            "/texture/input",
        ),
    ],
)
def test_what_cannot_be_looked_up_is_named(color, code, pointer):
    assert found(color) == [(code, AT + pointer)]


@pytest.mark.parametrize(
    "color",
    [
        {"coordinates": {"technique": "position"}},
        {"coordinates": REFLECTION, "layout": {"technique": "cube", "arrangement": "cross"}},
        {"coordinates": {"technique": "normal"}, "layout": {"technique": "mirror_ball"}},
        {"filter": "formula"},
        {"filter": "formula", "coordinates": {"technique": "position"}},
    ],
)
def test_what_can_is_not(color):
    assert found(color) == []


def test_a_normal_map_needs_a_picture():
    surface = {"technique": "unlit", "normal": {"texture": PERLIN, "filter": "formula"}}
    body = {"scene": {"nodes": [{"mesh": {"type": "plane"}, "surface": surface}]}}

    (obstacle,) = obstacles(RenderRequest.model_validate(body))

    assert (obstacle.code, obstacle.pointer) == (
        "formula_missing",
        "/scene/nodes/0/surface/normal/filter",
    )


def test_a_surface_has_up_to_so_many_formulas():
    texture = PERLIN
    for _ in range(FORMULAS_MAX - 1):
        texture = {
            "technique": "ramp",
            "input": texture,
            "stops": [{"position": 0.5, "color": [1, 1, 1]}],
        }
    more = {**texture, "input": texture}

    assert found({"texture": texture, "filter": "formula"}) == []
    assert found({"texture": more, "filter": "formula"}) == [
        ("too_many_maps", "/scene/nodes/0/surface")
    ]


@pytest.mark.parametrize(
    ("layout", "right", "wrong"),
    [
        ({"technique": "latlong"}, (64, 32), (64, 64)),
        ({"technique": "mirror_ball"}, (64, 64), (64, 32)),
        ({"technique": "dual_paraboloid"}, (64, 32), (32, 64)),
        ({"technique": "cube"}, (16, 96), (16, 80)),
        ({"technique": "cube", "arrangement": "tall_cross"}, (96, 128), (128, 96)),
    ],
)
def test_an_upload_must_have_the_shape_of_its_layout(layout, right, wrong):
    # A cube of five faces, and longitude and latitude that are not 2:1, are of another shape
    asked = request(
        {
            "texture": {"technique": "image", "asset": ASSET},
            "coordinates": REFLECTION,
            "layout": layout,
        }
    )

    def told(size):
        facts = ImageFacts(
            sha256=ASSET,
            bytes=9,
            media_type="image/png",
            format="png",
            kind="image",
            width=size[0],
            height=size[1],
            channels=3,
            bits=8,
            float=False,
            has_alpha=False,
        )
        return [(item.code, item.pointer) for item in misuses(asked, {ASSET: facts})]

    assert told(right) == []
    assert told(wrong) == [("layout_mismatch", AT + "/texture/asset")]


def test_formulas_volumes_and_three_projections_cost_what_they_take():
    def seconds(**color):
        return estimate(request(color, size=[1024, 1024]), {}).seconds

    plain = seconds()
    assert seconds(filter="formula") > plain + 0.3
    assert seconds(coordinates={"technique": "triplanar"}) > plain + 0.1
    octaves = {"technique": "perlin", "octaves": 12}
    assert seconds(filter="formula", texture=octaves) > seconds(filter="formula") + 1
    solid = estimate(request({"coordinates": {"technique": "position"}}), {})
    assert solid.bytes > 128**3 * 16
