import math

import pytest

from api_schemas import feasibility
from api_schemas.feasibility import assets_in, obstacles
from api_schemas.requests import RenderRequest, TextureRequest

BLACK = [{"position": 0, "color": [0, 0, 0]}]
STRAIGHT = {"eye": [0, 0, 4]}


def scene(pose=STRAIGHT, lights=(), nodes=(), **camera):
    return RenderRequest.model_validate(
        {
            "scene": {
                "camera": {"type": "perspective", "pose": pose, **camera},
                "lights": list(lights),
                "nodes": list(nodes),
            }
        }
    )


def node(transform, *children):
    return {"mesh": {"type": "sphere"}, "transform": transform, "children": list(children)}


def found(request):
    return [(obstacle.code, obstacle.pointer) for obstacle in obstacles(request)]


def matrix(*columns, last=1):
    rows = [[*list(column), 0] for column in columns]
    rows[3][3] = last
    return {"matrix": [number for row in rows for number in row]}


X, Y, Z, O = [1, 0, 0], [0, 1, 0], [0, 0, 1], [0, 0, 0]  # noqa: E741


def test_a_plain_scene_has_no_obstacles():
    quarter = {"rotation": [math.sin(math.pi / 4), 0, 0, math.cos(math.pi / 4)]}

    assert found(scene(nodes=[node(quarter, node({"scale": [-1, 2, 0.5]}))])) == []


@pytest.mark.parametrize(
    ("pose", "pointer"),
    [
        ({"eye": [0, 5, 0]}, "/scene/camera/pose/up"),
        ({"eye": [0, -5, 0]}, "/scene/camera/pose/up"),
        ({"eye": [1, 2, 3], "target": [1, 2, 3]}, "/scene/camera/pose/target"),
        ({"eye": [0, 0, 4], "up": [0, 0, 0]}, "/scene/camera/pose/up"),
        (matrix(X, X, Z, O), "/scene/camera/pose/matrix"),
        (matrix(X, Y, Z, O, last=0), "/scene/camera/pose/matrix"),
    ],
)
def test_a_camera_that_sees_nothing_is_degenerate(pose, pointer):
    assert found(scene(pose)) == [("camera_degenerate", pointer)]


def test_near_may_not_pass_far():
    assert found(scene(near=2.0, far=1.0)) == [("camera_degenerate", "/scene/camera/near")]


@pytest.mark.parametrize(
    "transform",
    [
        {"scale": [1, 0, 1]},
        {"rotation": [0, 0, 0, 0]},
        {"scale": [1e-10, 1, 1]},
        matrix(X, Y, [1, 1, 0], O),
        matrix(X, Y, Z, O, last=2),
    ],
)
def test_a_flat_transform_is_singular(transform):
    place = "/scene/nodes/0/children/0/transform"

    assert found(scene(nodes=[node({}, node(transform))])) == [("transform_singular", place)]


def test_stretches_that_are_fine_alone_may_be_too_much_together():
    big = {"scale": [1e6, 1e6, 1e6]}

    assert found(scene(nodes=[node(big, node(big))])) == [
        ("transform_singular", "/scene/nodes/0/children/0/transform")
    ]


def test_lights_need_a_direction_and_cones_an_order():
    spot = {"type": "spot", "position": [0, 1, 0], "inner_angle": 0.5, "outer_angle": 0.4}
    lights = [
        {"type": "directional", "direction": [0, 0, 0]},
        {**spot, "direction": [0, -1, 0]},
    ]

    assert found(scene(lights=lights)) == [
        ("light_degenerate", "/scene/lights/0/direction"),
        ("light_degenerate", "/scene/lights/1/outer_angle"),
    ]


@pytest.mark.parametrize(("levels", "codes"), [(32, []), (33, ["nesting_too_deep"])])
def test_textures_nest_up_to_32_levels(levels, codes):
    texture = {"technique": "perlin"}
    for _ in range(levels - 1):
        texture = {"technique": "ramp", "input": texture, "stops": BLACK}

    request = TextureRequest.model_validate({"texture": texture})

    assert [code for code, _ in found(request)] == codes


@pytest.mark.parametrize(("count", "codes"), [(1024, []), (1025, ["too_many_nodes"])])
def test_a_scene_has_up_to_1024_nodes(count, codes):
    halves = [node({}, *[node({})] * (count - 513)), *[node({})] * 512]

    assert [code for code, _ in found(scene(nodes=halves))] == codes


@pytest.mark.parametrize(("count", "codes"), [(256, []), (257, ["too_many_nodes"])])
def test_a_scene_has_up_to_256_textures_whatever_the_nodes(count, codes):
    surface = {"technique": "unlit", "color": {"texture": {"technique": "perlin"}}}
    plain = [node({})] * 500

    assert [
        c for c, _ in found(scene(nodes=[{**node({}), "surface": surface}] * count + plain))
    ] == codes


def test_a_surface_has_up_to_so_many_maps(monkeypatch):
    maps = {name: {"texture": {"technique": "perlin"}} for name in ("exponent", "diffuse_color")}
    request = scene(
        nodes=[
            {"mesh": {"type": "box"}},
            {"mesh": {"type": "box"}, "surface": {"technique": "phong", **maps}},
        ]
    )
    assert found(request) == []

    monkeypatch.setattr(feasibility, "MAPS_MAX", 1)  # no surface of today has more than 24

    assert found(request) == [("too_many_maps", "/scene/nodes/1/surface")]


def test_maps_that_tell_how_slopes_vary_count_twice(monkeypatch):
    def worn(kind, fine_detail):
        mapped = {"texture": {"technique": "perlin"}, "fine_detail": fine_detail}
        surface = {"technique": "metallic_roughness", kind: mapped}
        return found(scene(nodes=[{"mesh": {"type": "box"}, "surface": surface}]))

    monkeypatch.setattr(feasibility, "MAPS_MAX", 1)

    many = [("too_many_maps", "/scene/nodes/0/surface")]
    for kind, twice in (("normal", False), ("bump", False), ("height", True)):
        assert worn(kind, "lost") == []
        assert worn(kind, "roughness") == (many if twice else [])
        assert worn(kind, "streaks") == many


def test_assets_are_found_wherever_a_texture_may_stand():
    first, second = "1" * 64, "2" * 64
    surface = {
        "technique": "phong",
        "diffuse_color": {"texture": {"technique": "image", "asset": first}},
        "exponent": {
            "texture": {
                "technique": "ramp",
                "input": {"technique": "image", "asset": second},
                "stops": BLACK,
            }
        },
    }

    assert assets_in(scene(nodes=[{"mesh": {"type": "box"}, "surface": surface}])) == [
        ("/scene/nodes/0/surface/diffuse_color/texture/asset", first),
        ("/scene/nodes/0/surface/exponent/texture/input/asset", second),
    ]


@pytest.mark.parametrize(
    ("file_format", "layers", "codes"),
    [
        ("png", [], []),
        ("png", ["depth"], []),
        ("png", ["depth", "uv"], [("layers_need_exr", "/output/layers")]),
        (None, ["depth", "uv"], [("layers_need_exr", "/output/layers")]),
        ("exr", ["depth", "uv"], []),
    ],
)
def test_a_png_shows_one_layer(file_format, layers, codes):
    request = scene().model_dump()
    request["output"] |= {"format": file_format, "layers": layers}

    assert found(RenderRequest.model_validate(request)) == codes


def test_a_layer_that_a_texture_does_not_tell_is_named():
    body = {"texture": {"technique": "perlin"}, "output": {"layers": ["field"]}}

    assert found(TextureRequest.model_validate(body)) == [("layer_unknown", "/output/layers/0")]


@pytest.mark.parametrize(
    ("texture", "output", "codes"),
    [
        ({"technique": "perlin"}, {"slices": 9}, []),
        ({"technique": "granite"}, {"slices": 9, "arrangement": "layers", "format": "exr"}, []),
        (
            {"technique": "levels", "input": {"technique": "gray_scott"}},
            {"slices": 9},
            [("texture_not_solid", "/texture/input")],
        ),
        (
            {"technique": "perlin"},
            {"slices": 9, "layers": ["field"]},
            [("layer_unknown", "/output/layers"), ("layer_unknown", "/output/layers/0")],
        ),
        (
            {"technique": "perlin"},
            {"slices": 2, "arrangement": "layers", "format": "png"},
            [("layers_need_exr", "/output/arrangement")],
        ),
        ({"technique": "granite"}, {"slices": 9, "arrangement": "parts", "format": "exr"}, []),
        (
            {"technique": "perlin"},
            {"slices": 2, "arrangement": "parts", "format": "png"},
            [("layers_need_exr", "/output/arrangement")],
        ),
        (
            {"technique": "perlin"},
            {"slices": 2, "arrangement": "parts", "format": "exr", "mipmaps": True},
            [("mipmaps_need_one_part", "/output/mipmaps")],
        ),
        (
            {"technique": "perlin"},
            {"slices": 1024, "size": [1024, 512]},
            [("atlas_too_large", "/output/slices")],
        ),
    ],
)
def test_slices_need_a_solid_texture_and_a_file_that_holds_them(texture, output, codes):
    body = {"texture": texture, "output": output}

    assert found(TextureRequest.model_validate(body)) == codes


def test_lights_share_four_pictures():
    def spot(number):
        picture = {"technique": "perlin", "seed": number}
        return {
            "type": "spot",
            "position": [0, 0, 5],
            "direction": [0, 0, -1],
            "cookie": {"texture": picture},
        }

    assert found(scene(lights=[spot(number % 4) for number in range(12)])) == []
    assert found(scene(lights=[spot(number) for number in range(5)])) == [
        ("too_many_maps", "/scene/lights")
    ]


def test_a_lantern_needs_a_turn_and_a_layout_that_can_be():
    def lamp(**cookie):
        texture = {"technique": "perlin"}
        light = {"type": "point", "position": [0, 0, 5], "cookie": {"texture": texture, **cookie}}
        return found(scene(lights=[light]))

    assert lamp(rotation=[0, 0, 2, 0]) == []
    place = "/scene/lights/0/cookie"
    assert lamp(rotation=[0, 0, 0, 0]) == [("light_degenerate", f"{place}/rotation")]
    fisheye = {"technique": "fisheye", "model": "orthographic", "angle": 4.0}
    assert lamp(layout=fisheye) == [("layout_impossible", f"{place}/layout/angle")]
    sky = {"environment": {"texture": {"technique": "perlin"}, "layout": fisheye}, "nodes": []}
    assert found(RenderRequest.model_validate({"scene": sky})) == [
        ("layout_impossible", "/scene/environment/layout/angle")
    ]


def test_lanterns_share_the_four_pictures_with_slides():
    def lamp(number):
        layout = {"technique": "fisheye", "angle": 1.0 + number}
        cookie = {"texture": {"technique": "perlin"}, "layout": layout}
        return {"type": "point", "position": [0, 0, 5], "cookie": cookie}

    assert found(scene(lights=[lamp(number % 4) for number in range(12)])) == []
    assert found(scene(lights=[lamp(number) for number in range(5)])) == [
        ("too_many_maps", "/scene/lights")
    ]
