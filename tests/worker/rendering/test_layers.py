"""What is told of pixels beside their light, against rays met with planes, spheres and boxes."""

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
FOV = 0.9
WHITE = {"technique": "unlit"}
NOWHERE = 1e10


def looking(eye: list[float], target: list[float], **camera: Any) -> dict[str, Any]:
    return {
        "type": "perspective",
        "fov_y": FOV,
        "pose": {"eye": eye, "target": target},
        **camera,
    }


def rays(eye: Any, target: Any, side: int) -> tuple[np.ndarray, np.ndarray]:
    """Unit vector of the view axis, and ways through the pixels' middles, one along the axis."""
    axis = np.subtract(target, eye) / np.linalg.norm(np.subtract(target, eye))
    right = np.cross(axis, [0, 1, 0])
    right /= np.linalg.norm(right)
    up = np.cross(right, axis)
    row, column = np.mgrid[0:side, 0:side] + 0.5
    slope = np.tan(FOV / 2)
    x, y = (2 * column / side - 1) * slope, (1 - 2 * row / side) * slope
    return axis, axis + x[..., None] * right + y[..., None] * up


def column_major(matrix: np.ndarray) -> list[float]:
    return list(map(float, matrix.T.ravel()))


def turned(x: float, y: float) -> np.ndarray:
    cx, sx, cy, sy = np.cos(x), np.sin(x), np.cos(y), np.sin(y)
    return np.array([[cy, 0, sy], [0, 1, 0], [-sy, 0, cy]]) @ np.array(
        [[1, 0, 0], [0, cx, -sx], [0, sx, cx]]
    )


@pytest.mark.parametrize("supersampling", [1, 4])
@pytest.mark.parametrize("kind", ["perspective", "orthographic"])
def test_a_plane_at_three_is_at_three_off_the_axis_too(
    studio: Studio, kind: str, supersampling: int
) -> None:
    camera = {"type": kind, "pose": {"eye": [0.3, -0.2, 3.0], "target": [0.3, -0.2, 0.0]}}
    wall = {"mesh": {"type": "plane", "width": 50.0, "height": 50.0}, "surface": WHITE}

    drawn = studio.layers({"camera": camera, "nodes": [wall]}, ["depth"], (64, 48), supersampling)

    assert (drawn["depth"] == 3).all()


def test_depth_is_along_the_view_axis_wherever_one_looks(studio: Studio) -> None:
    eye, target = np.array([2.0, 1.0, -3.0]), np.array([-1.0, 0.5, 4.0])
    axis, _ = rays(eye, target, 1)
    right = np.cross(axis, [0, 1, 0]) / np.linalg.norm(np.cross(axis, [0, 1, 0]))
    matrix = np.eye(4)
    matrix[:3, :3] = np.stack([right, np.cross(right, axis), -axis], axis=1)
    matrix[:3, 3] = eye + 3 * axis
    wall = {
        "mesh": {"type": "plane", "width": 20.0, "height": 20.0},
        "transform": {"matrix": column_major(matrix)},
        "surface": WHITE,
    }

    camera = looking(eye.tolist(), target.tolist())
    drawn = studio.layers({"camera": camera, "nodes": [wall]}, ["depth"])

    # Corners 10 away from the middle are rounded at 2^-24 of that.
    np.testing.assert_allclose(drawn["depth"], 3, atol=3e-6)


def test_a_tilted_plane(studio: Studio) -> None:
    eye, target, side = [1.0, 2.0, 3.0], [0.2, 0.1, 0.0], 100
    matrix = np.eye(4)
    matrix[:3, :3] = turned(-0.9, 0.4) * [0.9, 1.3, 1.0]
    matrix[:3, 3] = [0.1, -0.2, 0.3]
    a, b, p = matrix[:3, 0], matrix[:3, 1], matrix[:3, 3]
    _, ways = rays(eye, target, side)
    normal = np.cross(a, b) / np.linalg.norm(np.cross(a, b))
    depth = (p - eye) @ normal / (ways @ normal)
    place = eye + depth[..., None] * ways
    x, y = (place - p) @ a / (a @ a), (place - p) @ b / (b @ b)
    uv = np.stack([(x + 1) / 2, (y + 1) / 2], axis=2)

    drawn = studio.layers(
        {
            "camera": looking(eye, target),
            "nodes": [
                {
                    "mesh": {"type": "plane"},
                    "transform": {"matrix": column_major(matrix)},
                    "surface": WHITE,
                }
            ],
        },
        ALL,
        (side, side),
    )

    inside = (np.maximum(np.abs(x), np.abs(y)) < 0.98) & (depth > 0)
    assert 1000 < inside.sum() < side * side
    assert (drawn["object_id"][inside] == 1).all()
    for name, expected in (
        ("depth", depth[..., None]),
        ("position", place),
        ("normal", np.broadcast_to(normal, place.shape)),
        ("tangent", np.broadcast_to(a / np.linalg.norm(a), place.shape)),
        ("geometric_normal", np.broadcast_to(normal, place.shape)),
        ("uv", uv),
    ):
        np.testing.assert_allclose(drawn[name][inside], expected[inside], atol=1e-5, err_msg=name)


def test_a_ball(studio: Studio) -> None:
    eye, target, side = np.array([0.5, 0.4, 3.0]), [0.0, 0.0, 0.0], 150
    # Edges lie up to (pi / 1400)^2 / 2 = 2.5e-6 below the ball, facets twice that, and slanted rays
    # meet them by as much as 1 / slant later.
    ball = {"type": "sphere", "segments": 1400, "rings": 700}
    _, ways = rays(eye, target, side)
    half_b, c = ways @ eye, eye @ eye - 1
    squared = (ways * ways).sum(axis=2)
    root = half_b**2 - squared * c
    depth = (-half_b - np.sqrt(np.maximum(root, 0))) / squared
    place = eye + depth[..., None] * ways
    slant = -(place * ways).sum(axis=2) / np.sqrt(squared)
    inside = (root > 0) & (slant > 0.6)
    poles = np.hypot(place[..., 0], place[..., 2]) < 0.1

    drawn = studio.layers(
        {
            "camera": looking(eye.tolist(), target),
            "nodes": [{"mesh": ball, "surface": WHITE}],
        },
        ALL,
        (side, side),
    )

    assert inside.sum() > 2000
    np.testing.assert_allclose(drawn["position"][inside], place[inside], atol=1e-5)
    np.testing.assert_allclose(drawn["depth"][inside][..., 0], depth[inside], atol=1e-5)
    np.testing.assert_allclose(drawn["normal"][inside], place[inside], atol=1e-5)
    # A facet's normal is that of the ball somewhere on the facet, pi / 700 across.
    off = np.linalg.norm(drawn["geometric_normal"] - place, axis=2)
    assert 1e-5 < off[inside].max() < np.pi / 700
    longitude = np.arctan2(-place[..., 2], place[..., 0]) % (2 * np.pi) / (2 * np.pi)
    latitude = np.arcsin(np.clip(place[..., 1], -1, 1)) / np.pi + 0.5
    clear = inside & ~poles & (np.abs(longitude - 0.5) < 0.49)
    np.testing.assert_allclose(drawn["uv"][clear][:, 1], latitude[clear], atol=1e-5)
    np.testing.assert_allclose(drawn["uv"][clear][:, 0], longitude[clear], atol=1e-5)
    east = np.stack([place[..., 2], 0 * depth, -place[..., 0]], axis=2)
    east /= np.linalg.norm(east, axis=2, keepdims=True)
    off = np.linalg.norm(drawn["tangent"] - east, axis=2)
    assert off[inside & ~poles].max() < np.pi / 700  # the mean of the facets round a vertex


@pytest.mark.parametrize("scale", [[1, 1, 1], [-1, 1, 1], [1e-3, 1e-3, 1e-3]])
@pytest.mark.parametrize("inside", [False, True])
def test_flat_sides_of_a_box_face_the_eye(studio: Studio, inside: bool, scale: list[float]) -> None:
    turn = turned(0.5, 0.7)
    matrix = np.eye(4)
    matrix[:3, :3] = turn * scale * (20 if inside else 1)
    eye = np.array([0.3, 0.2, 4.0]) * abs(scale[0])
    camera = looking(eye.tolist(), [0.0, 0.0, 0.0], near=1e-4)

    drawn = studio.layers(
        {
            "camera": camera,
            "nodes": [
                {
                    "mesh": {"type": "box"},
                    "transform": {"matrix": column_major(matrix)},
                    "surface": WHITE,
                }
            ],
        },
        ["normal", "geometric_normal", "object_id"],
        (80, 80),
    )

    covered = drawn["object_id"][..., 0] == 1
    flat = drawn["geometric_normal"][covered]
    sides = np.concatenate([turn.T, -turn.T])
    nearest = sides[np.argmax(flat @ sides.T, axis=1)]
    np.testing.assert_allclose(flat, nearest, atol=1e-6)
    np.testing.assert_allclose(drawn["normal"][covered], flat, atol=1e-6)
    _, ways = rays(eye, [0, 0, 0], 80)
    assert ((flat * ways[covered]).sum(axis=1) < 0).all()
    assert len(np.unique(np.round(flat, 3), axis=0)) >= (2 if inside else 3)


def test_facets_are_flat(studio: Studio) -> None:
    ball = {"type": "sphere", "segments": 7, "rings": 5}
    turn = turned(0.4, 0.3)
    matrix = np.eye(4)
    matrix[:3, :3] = turn * [1.0, 2.0, 0.5]

    drawn = studio.layers(
        {
            "camera": looking([1.0, 2.0, 5.0], [0.0, 0.0, 0.0]),
            "nodes": [
                {"mesh": ball, "transform": {"matrix": column_major(matrix)}, "surface": WHITE}
            ],
        },
        ["position", "geometric_normal", "object_id"],
        (200, 200),
    )

    covered = drawn["object_id"][..., 0] == 1
    flat, place = drawn["geometric_normal"][covered], drawn["position"][covered]
    normals, facet = np.unique(np.round(flat, 5), axis=0, return_inverse=True)
    assert 10 < len(normals) <= 7 * 4 * 2
    for index, normal in enumerate(normals):
        heights = place[facet == index] @ normal
        assert np.ptp(heights) < 2e-5  # the normal was rounded to 1e-5


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


@pytest.mark.parametrize("technique", FAMILIES["surfaces"])
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
