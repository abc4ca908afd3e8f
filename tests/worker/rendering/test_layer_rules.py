"""What layers hold where things meet, end, let light through or have no surface."""

from typing import Any, get_args

import numpy as np
import pytest

from api_schemas.language import FAMILIES
from api_schemas.output import Layer
from tests.worker.rendering.studio import Studio
from tests.worker.rendering.test_renderer import still_life
from worker.geometry.mesh import Mesh

pytestmark = pytest.mark.gl

ALL = list(get_args(Layer))
NOWHERE = 1e10


def sheet(x0: float, x1: float, z: float, **node: Any) -> dict[str, Any]:
    """A sheet 2 high that faces +z and reaches from x0 to x1."""
    return {
        "mesh": {"type": "plane", "width": x1 - x0, "height": 2.0},
        "transform": {"translation": [(x0 + x1) / 2, 0.0, z]},
        **node,
    }


def unlit(*color: float) -> dict[str, Any]:
    return {"surface": {"technique": "unlit", "color": list(color)}}


STRAIGHT = {
    "type": "orthographic",
    "height": 2.0,
    "pose": {"eye": [0.0, 0.0, 5.0], "target": [0.0, 0.0, 0.0]},
}


def test_a_half_covered_pixel_belongs_to_the_nearest_thing_with_half_its_light(
    studio: Studio,
) -> None:
    near = sheet(-1.0, 0.5, 1.0, **unlit(0.5, 0.25, 1.0))
    far = sheet(-1.0, 1.0, 0.0, **unlit(0.0, 1.0, 0.5))

    drawn = studio.layers({"camera": STRAIGHT, "nodes": [far, near]}, ALL, (2, 2), 4)

    # The near sheet ends in the middle of the right pixels.
    assert drawn["object_id"][..., 0].tolist() == [[2, 2]] * 2
    assert drawn["material_id"][..., 0].tolist() == [[2, 2]] * 2
    assert drawn["depth"][..., 0].tolist() == [[4, 4]] * 2
    assert drawn["position"][0, 1, 2] == 1
    assert drawn["position"][0, 1, 0] == 0.125  # the first of equally near samples, at the left
    for name in ("picture", "albedo"):
        assert drawn[name][0].tolist() == [[0.5, 0.25, 1, 1], [0.25, 0.625, 0.75, 1]]
    assert (drawn["coverage"] == 1).all()


def test_at_an_edge_over_nothing_light_fades_and_facts_do_not(studio: Studio) -> None:
    near = sheet(-1.0, 0.5, 1.0, **unlit(0.5, 0.25, 1.0))

    drawn = studio.layers({"camera": STRAIGHT, "nodes": [near]}, ALL, (4, 4), 4)

    assert drawn["coverage"][0, :, 0].tolist() == [1, 1, 1, 0]
    drawn = studio.layers({"camera": STRAIGHT, "nodes": [near]}, ALL, (2, 2), 4)
    assert drawn["coverage"][0, :, 0].tolist() == [1, 0.5]
    assert drawn["albedo"][0, 1].tolist() == [0.25, 0.125, 0.5, 0.5]
    assert drawn["picture"][0, 1].tolist() == [0.25, 0.125, 0.5, 0.5]
    assert drawn["depth"][0, :, 0].tolist() == [4, 4]
    assert drawn["normal"][0, 1].tolist() == [0, 0, 1]


def test_where_nothing_is_all_is_zero_but_the_depth(studio: Studio) -> None:
    drawn = studio.layers({"camera": STRAIGHT, "nodes": []}, ALL, (3, 2), 2)

    assert (drawn.pop("depth") == NOWHERE).all()
    assert not any(layer.any() for layer in drawn.values())


@pytest.mark.parametrize("supersampling", [1, 4])
def test_ids_count_things_depth_first_and_are_whole(studio: Studio, supersampling: int) -> None:
    red, green = unlit(1, 0, 0), unlit(0, 1, 0)
    nodes = [
        {
            "transform": {"translation": [-0.6, 0.0, 0.0]},
            "children": [
                {"mesh": {"type": "sphere", "radius": 0.4}, **red},
                {
                    "transform": {"translation": [0.3, 0.3, 0.3]},
                    "mesh": {"type": "sphere", "radius": 0.3},
                    **green,
                    "children": [
                        {
                            "transform": {"translation": [0.3, 0.0, 0.0]},
                            "mesh": {"type": "sphere", "radius": 0.3},
                            **red,
                        }
                    ],
                },
            ],
        },
        {
            "transform": {"translation": [0.5, -0.4, 0.0], "rotation": [0.3, 0.4, 0.0, 0.87]},
            "mesh": {"type": "box", "width": 0.8, "height": 0.8, "depth": 0.8},
        },
    ]

    drawn = studio.layers(
        {"camera": STRAIGHT, "nodes": nodes}, ["object_id", "material_id"], (60, 60), supersampling
    )

    objects, materials = drawn["object_id"][..., 0], drawn["material_id"][..., 0]
    assert set(np.unique(objects)) == {0, 1, 2, 3, 4}
    material_of = np.array([0, 1, 2, 1, 3])  # red, green, red again, the grey of no surface
    np.testing.assert_array_equal(materials, material_of[objects.astype(int)])
    assert objects[30, 12] == 1  # the first sphere's middle is at x = -.6, in column 12
    assert objects[42, 45] == 4


@pytest.mark.parametrize("supersampling", [1, 3])
def test_layers_change_no_bit_of_the_picture(studio: Studio, supersampling: int) -> None:
    scene = still_life(studio)

    alone = studio.draw(scene, (150, 110), supersampling)
    with_layers = studio.layers(scene, ALL, (150, 110), supersampling)

    np.testing.assert_array_equal(with_layers["picture"], alone)
    np.testing.assert_array_equal(with_layers["coverage"], alone[..., 3:])


def test_one_layer_is_that_of_all(studio: Studio) -> None:
    scene = still_life(studio)
    every = studio.layers(scene, ALL, (50, 40), 2)

    for name in ALL:
        if name.startswith("crypto_"):
            continue  # several pictures of its own each: tests/worker/rendering/test_cryptomatte.py
        alone = studio.layers(scene, [name], (50, 40), 2)
        assert list(alone) == ["picture", name]
        np.testing.assert_array_equal(alone[name], every[name])


def test_layers_in_tiles_are_the_layers(studio: Studio, monkeypatch: pytest.MonkeyPatch) -> None:
    from worker.rendering import renderer  # noqa: PLC0415  needs OpenGL

    scene = still_life(studio)
    whole = studio.layers(scene, ALL, (150, 110))
    monkeypatch.setattr(renderer, "tile_size", lambda *picture: (64, 32))
    cut = studio.layers(scene, ALL, (150, 110))

    # A tile's clip coordinates are rounded anew: a corner may fall to the next 1/256 of a pixel.
    same = (cut["object_id"] == whole["object_id"])[..., 0]
    assert same.mean() > 0.998
    for name in ("depth", "position", "uv", "normal"):
        error = np.abs(cut[name] - whole[name])[same].max(axis=1)
        assert np.quantile(error, 0.95) < 2e-4, name


@pytest.mark.parametrize(
    "technique", [name for name, spec in FAMILIES["surfaces"].items() if not spec.fills_box]
)
def test_every_surface_has_layers(studio: Studio, technique: str) -> None:
    scene = {
        "camera": STRAIGHT,
        "nodes": [{"mesh": {"type": "plane"}, "surface": {"technique": technique}}],
    }

    drawn = studio.layers(scene, ALL)

    assert (drawn["object_id"] == 1).all()
    assert (drawn["albedo"][..., :3] > 0.1).all()
    assert (drawn["tangent"] == [1, 0, 0]).all()


def test_what_is_blended_tints_the_albedo_and_leaves_the_rest_to_what_is_behind(
    studio: Studio,
) -> None:
    glass = {
        "surface": {
            "technique": "unlit",
            "color": [1.0, 0.0, 0.0],
            "alpha_mode": "blend",
            "opacity": 0.25,
        }
    }
    wall = sheet(-1.0, 0.0, 0.0, **unlit(0.0, 1.0, 0.5))
    pane = sheet(-1.0, 1.0, 1.0, **glass)

    with_pane = studio.layers({"camera": STRAIGHT, "nodes": [pane, wall]}, ALL, (2, 2), 2)
    without = studio.layers({"camera": STRAIGHT, "nodes": [{}, wall]}, ALL, (2, 2), 2)

    assert with_pane["albedo"][0].tolist() == [[0.25, 0.75, 0.375, 1], [0.25, 0, 0, 0.25]]
    assert with_pane["picture"][0].tolist() == with_pane["albedo"][0].tolist()
    assert with_pane["coverage"][0, :, 0].tolist() == [1, 0.25]
    assert with_pane["object_id"][0, :, 0].tolist() == [2, 0]
    assert with_pane["depth"][0, :, 0].tolist() == [5, np.float32(NOWHERE)]
    for name in ("position", "normal", "geometric_normal", "tangent", "uv"):
        np.testing.assert_array_equal(with_pane[name], without[name])


def test_a_background_is_no_thing(studio: Studio) -> None:
    texture = studio.texture(np.full((2, 2, 3), 0.5))
    for background in ([0.5, 0.5, 0.5], {"texture": texture}):
        scene = {
            "camera": STRAIGHT,
            "background": background,
            "nodes": [sheet(-1.0, 0.0, 0.0, **unlit(0.0, 1.0, 0.0))],
        }

        drawn = studio.layers(scene, ALL, (2, 2), 2)

        assert drawn["picture"][0].tolist() == [[0, 1, 0, 1], [0.5, 0.5, 0.5, 1]]
        assert drawn["coverage"][0, :, 0].tolist() == [1, 0]
        assert drawn["albedo"][0].tolist() == [[0, 1, 0, 1], [0, 0, 0, 0]]
        assert drawn["object_id"][0, :, 0].tolist() == [1, 0]


def test_a_hole_shows_what_is_behind_it(studio: Studio) -> None:
    holes = {"texture": studio.texture([[1.0, 0.0]]), "filter": "nearest"}
    net = {"technique": "unlit", "alpha_mode": "mask", "opacity": holes}
    nodes = [sheet(-1.0, 1.0, 1.0, surface=net), sheet(-1.0, 1.0, 0.0, **unlit(0, 0, 1))]

    drawn = studio.layers({"camera": STRAIGHT, "nodes": nodes}, ALL, (2, 2), 2)

    assert drawn["object_id"][0, :, 0].tolist() == [1, 2]
    assert drawn["depth"][0, :, 0].tolist() == [4, 5]


@pytest.mark.parametrize(
    ("surface", "color"),
    [
        ({"technique": "unlit", "color": [0.2, 3.0, 0.4]}, (0.2, 3.0, 0.4)),
        (
            {
                "technique": "phong",
                "diffuse_color": [0.2, 0.4, 0.8],
                "diffuse_weight": 0.5,
                "specular_weight": 0.7,
                "emission": [1.0, 1.0, 1.0],
            },
            (0.1, 0.2, 0.4),
        ),
    ],
    ids=["unlit", "phong"],
)
def test_albedo_is_what_is_reflected_whatever_shines(
    studio: Studio, surface: dict[str, Any], color: tuple[float, ...]
) -> None:
    scene = {
        "camera": STRAIGHT,
        "lights": [{"type": "directional", "direction": [0.0, 0.0, -1.0], "irradiance": 9.0}],
        "nodes": [{"mesh": {"type": "plane"}, "surface": surface}],
    }

    drawn = studio.layers(scene, ["albedo"])

    expected = np.broadcast_to(np.float32([*color, 1]), (32, 32, 4))
    np.testing.assert_allclose(drawn["albedo"], expected, rtol=1e-6)


def test_a_map_is_in_the_albedo(studio: Studio) -> None:
    texels = np.random.default_rng(3).random((32, 32, 3))
    color = {"texture": studio.texture(texels), "filter": "nearest"}
    scene = {
        "camera": STRAIGHT,
        "lights": [],
        "nodes": [
            {"mesh": {"type": "plane"}, "surface": {"technique": "phong", "diffuse_color": color}}
        ],
    }

    drawn = studio.layers(scene, ["albedo"])

    assert not drawn["picture"][..., :3].any()
    np.testing.assert_array_equal(drawn["albedo"][..., :3], np.float32(texels))


def test_lines_have_no_normals_but_ids_and_colours(studio: Studio) -> None:
    line = Mesh(
        positions=np.array([[-0.9, 0.05, 0.0], [0.9, 0.05, 0.0]]),
        normals=np.zeros((2, 3)),
        uv_sets=(),
        triangles=np.array([[0, 1]], np.uint32),
        colors=np.array([[0.5, 0.25, 1.0, 1.0]] * 2),
        kind="lines",
    )
    scene = {"camera": STRAIGHT, "nodes": [{"mesh": studio.mesh(line), **unlit(1, 1, 1)}]}

    drawn = studio.layers(scene, ALL, (40, 40))

    hit = drawn["object_id"][..., 0] == 1
    assert 30 < hit.sum() < 80
    assert not drawn["geometric_normal"].any()
    assert not drawn["normal"].any()
    assert (drawn["depth"][hit] == 5).all()
    assert (drawn["albedo"][hit] == [0.5, 0.25, 1, 1]).all()
