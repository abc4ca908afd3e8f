"""Opacity: what is cut, what lets light through, and in which order."""

import itertools
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from api_schemas import meshes
from tests.run_example import run_example
from tests.worker.rendering.studio import Studio
from worker.geometry import primitives
from worker.geometry.mesh import Mesh
from worker.geometry.plane import plane
from worker.images import image_io
from worker.images.image import Image

pytestmark = pytest.mark.gl

CAMERA = {"type": "orthographic", "height": 2.0, "pose": {"eye": [0.0, 0.0, 10.0]}}
RED, GREEN, BLUE = [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]


def glass(color: list[float], opacity: Any = 0.5, **more: Any) -> dict[str, Any]:
    surface = {"technique": "unlit", "color": color, "opacity": opacity, "alpha_mode": "blend"}
    return surface | more


def poster(z: float, surface: dict[str, Any], **transform: Any) -> dict[str, Any]:
    placed = {"translation": [0.0, 0.0, z]} | transform
    return {"mesh": {"type": "plane"}, "transform": placed, "surface": surface}


def over(front: np.ndarray, back: np.ndarray) -> np.ndarray:
    """Porter and Duff (1984), premultiplied."""
    return front + back * (1 - front[..., 3:])


def premultiplied(color: list[float], opacity: float) -> np.ndarray:
    return np.array([*color, 1.0]) * opacity


@pytest.mark.parametrize("order", list(itertools.permutations(range(4))))
def test_panes_over_a_ground_are_the_over_operator_in_any_order_of_request(
    studio: Studio, order: tuple[int, ...]
) -> None:
    nodes = [
        poster(0.0, {"technique": "unlit", "color": [0.25, 0.5, 0.75]}),
        poster(1.0, glass([4.0, 0.0, 0.0])),
        poster(2.0, glass(GREEN, 0.25)),
        poster(3.0, glass(BLUE, 0.5)),
    ]

    drawn = studio.draw({"camera": CAMERA, "nodes": [nodes[index] for index in order]})

    expected = np.array([0.25, 0.5, 0.75, 1.0])
    for color, opacity in (([4.0, 0, 0], 0.5), (GREEN, 0.25), (BLUE, 0.5)):
        expected = over(premultiplied(color, opacity), expected)
    np.testing.assert_allclose(drawn, np.broadcast_to(expected, drawn.shape), rtol=1e-6)


def test_over_nothing_the_result_is_premultiplied(studio: Studio) -> None:
    nodes = [poster(0.0, glass(RED, 0.5)), poster(1.0, glass(BLUE, 0.5))]

    drawn = studio.draw({"camera": CAMERA, "nodes": nodes})

    np.testing.assert_allclose(drawn[16, 16], [0.25, 0.0, 0.5, 0.75], rtol=1e-6)


def test_what_is_behind_something_opaque_is_hidden_and_hides_nothing_itself(studio: Studio) -> None:
    nodes = [
        poster(2.0, glass(RED)),
        poster(0.0, glass(GREEN)),
        poster(1.0, {"technique": "unlit", "color": BLUE}),
        # Opaque and behind a pane: it would be lost if the pane had written its depth.
        poster(1.5, {"technique": "unlit", "color": [1.0, 1.0, 1.0]}, scale=[0.5, 0.5, 1.0]),
    ]

    drawn = studio.draw({"camera": CAMERA, "nodes": nodes})

    np.testing.assert_allclose(drawn[16, 1], [0.5, 0.0, 0.5, 1.0], rtol=1e-6)
    np.testing.assert_allclose(drawn[16, 16], [1.0, 0.5, 0.5, 1.0], rtol=1e-6)


def test_a_pane_that_cuts_something_opaque_covers_the_part_behind_it(studio: Studio) -> None:
    # Its middle is nearer than the pane's, but its right half leans back beyond the pane.
    eighth = [0.0, 0.38268343, 0.0, 0.92387953]
    slope = poster(0.1, {"technique": "unlit", "color": BLUE}, rotation=eighth)

    drawn = studio.draw({"camera": CAMERA, "nodes": [slope, poster(0.0, glass(RED))]})

    np.testing.assert_allclose(drawn[16, 8], [0.0, 0.0, 1.0, 1.0], rtol=1e-6)
    np.testing.assert_allclose(drawn[16, 24], [0.5, 0.0, 0.5, 1.0], rtol=1e-6)


def test_what_is_nearer_along_the_view_is_in_front_though_its_middle_is_far_aside(
    studio: Studio,
) -> None:
    wide = poster(1.0, glass(RED), scale=[40.0, 1.0, 1.0], translation=[30.0, 0.0, 1.0])

    drawn = studio.draw({"camera": CAMERA, "nodes": [wide, poster(0.0, glass(BLUE))]})

    np.testing.assert_allclose(drawn[16, 16], [0.5, 0.0, 0.25, 0.75], rtol=1e-6)


def test_of_equally_near_panes_the_later_one_is_in_front(studio: Studio) -> None:
    red, blue = poster(0.0, glass(RED)), poster(0.0, glass(BLUE))

    drawn = [
        studio.draw({"camera": CAMERA, "nodes": n})[16, 16] for n in ([red, blue], [blue, red])
    ]

    np.testing.assert_allclose(drawn[0], [0.25, 0.0, 0.5, 0.75], rtol=1e-6)
    np.testing.assert_allclose(drawn[1], [0.5, 0.0, 0.25, 0.75], rtol=1e-6)


def test_highlights_and_emission_are_dimmed_with_the_rest(studio: Studio) -> None:
    surface = {"technique": "phong", "emission": [2.0, 2.0, 2.0], "specular_weight": 1.0}
    lights = [{"type": "directional", "direction": [0.0, 0.0, -1.0]}]

    opaque = studio.poster(surface, lights=lights)
    blended = studio.poster(surface | {"alpha_mode": "blend", "opacity": 0.25}, lights=lights)

    np.testing.assert_array_equal(blended, 0.25 * opaque)


RAMP = np.tile((np.arange(64, dtype=np.float32) + 0.5) / 64, (4, 1))
"""Opacity that grows from left to right: AlphaBlendModeTest's idea, one texel a pixel."""


def ramp(studio: Studio, **more: Any) -> np.ndarray:
    mapped = {"texture": studio.texture(RAMP), "filter": "nearest"}
    surface = glass([0.5, 1.0, 2.0], mapped, **more)
    return studio.poster(surface, (64, 4))


def test_opaque_ignores_opacity(studio: Studio) -> None:
    drawn = ramp(studio, alpha_mode="opaque")

    assert (drawn == np.array([0.5, 1.0, 2.0, 1.0])).all()


def test_blend_is_as_opaque_as_the_texel(studio: Studio) -> None:
    drawn = ramp(studio)

    np.testing.assert_allclose(drawn, RAMP[..., None] * [0.5, 1.0, 2.0, 1.0], rtol=1e-6)


@pytest.mark.parametrize("cutoff", [0.0, 0.25, 0.5, 0.75, 1.0])
def test_mask_shows_what_reaches_the_cutoff_as_a_whole(studio: Studio, cutoff: float) -> None:
    drawn = ramp(studio, alpha_mode="mask", alpha_cutoff=cutoff)

    expected = (cutoff <= RAMP)[..., None] * [0.5, 1.0, 2.0, 1.0]
    np.testing.assert_array_equal(drawn, expected)


def test_opacity_at_the_cutoff_is_opaque_as_gltf_says(studio: Studio) -> None:
    surface = {"technique": "unlit", "alpha_mode": "mask", "alpha_cutoff": 0.3, "opacity": 0.3}

    assert (studio.poster(surface) == 1).all()
    assert not studio.poster(surface | {"opacity": 0.2999}).any()


def test_through_a_hole_one_sees_what_is_behind(studio: Studio) -> None:
    holes = np.array([[1.0, 0.0], [0.0, 1.0]])
    mapped = {"texture": studio.texture(holes), "filter": "nearest"}
    nodes = [
        poster(1.0, glass(RED, mapped, alpha_mode="mask")),
        poster(0.0, {"technique": "unlit", "color": BLUE}),
    ]

    drawn = studio.draw({"camera": CAMERA, "nodes": nodes}, (4, 4))

    expected = np.where(np.kron(holes, np.ones((2, 2)))[..., None] > 0, [*RED, 1], [*BLUE, 1])
    np.testing.assert_array_equal(drawn, expected)


@pytest.mark.parametrize("share", [0.15, 0.5, 0.85])
@pytest.mark.parametrize("how", [{}, {"scale": -1.0, "bias": 1.0}])
def test_leaves_keep_their_share_where_they_are_small(
    studio: Studio, share: float, how: dict[str, Any]
) -> None:
    # Leaves of one texel, seen so small that each pixel holds eight by eight of them.
    leaves = np.random.default_rng(5).random((512, 512)) < share
    stored = studio.texture(1.0 - leaves if how else leaves)
    surface = glass([1.0, 1.0, 1.0], {"texture": stored} | how, alpha_mode="mask")

    drawn = studio.poster(surface, (64, 64))

    # Each level has the right share; between two levels, and between texels, what is read is nearer
    # to the mean. Without the care for it the smaller share would be gone altogether.
    assert drawn[..., 3].mean() == pytest.approx(leaves.mean(), abs=0.12)
    assert 0.03 < drawn[..., 3].mean() < 0.97


@pytest.mark.parametrize(
    ("value", "alpha"),
    [(-3.0, 0.0), (0.0, 0.0), (7.0, 1.0), (np.inf, 1.0), (-np.inf, 0.0), (np.nan, 0.0)],
)
def test_any_number_in_a_picture_is_some_opacity(
    studio: Studio, value: float, alpha: float
) -> None:
    mapped = {"texture": studio.texture(np.full((1, 1), value)), "filter": "nearest"}

    blended = studio.poster(glass([1.0, 1.0, 1.0], mapped))
    masked = studio.poster(glass([1.0, 1.0, 1.0], mapped, alpha_mode="mask"))

    assert (blended == alpha).all()
    assert (masked == alpha).all()


def test_light_beyond_what_a_picture_holds_is_cut_before_it_is_dimmed(studio: Studio) -> None:
    drawn = studio.poster(glass([1e38, 0.0, 0.0], 0.5))

    np.testing.assert_allclose(drawn[16, 16], [2.5e36, 0.0, 0.0, 0.5], rtol=1e-6)


SHAPES: dict[str, meshes.Mesh] = {
    "sphere": meshes.Sphere(type="sphere", segments=32, rings=16),
    "sphere, sorted": meshes.Sphere(type="sphere", segments=300, rings=150),
    "box": meshes.Box(type="box", width=1.2, height=0.8, depth=3.0),
    "can": meshes.Cylinder(type="cylinder", caps=True, height=1.0),
    "tube": meshes.Cylinder(type="cylinder", height=1.0),
}


@pytest.mark.parametrize("name", SHAPES)
@pytest.mark.parametrize("turn", [[0, 0, 0, 1], [0.3, -0.5, 0.2, 0.7], [1, 0, 0, 0], [0, 1, 1, 0]])
@pytest.mark.parametrize("mirror", [1.0, -1.0])
def test_a_closed_shape_shows_its_inner_back_through_its_front(
    studio: Studio, name: str, turn: list[float], mirror: float
) -> None:
    shape = primitives.build(SHAPES[name])
    inside_out = replace(shape, triangles=shape.triangles[:, ::-1].copy(), normals=-shape.normals)

    def drawn(mesh: Mesh, **surface: Any) -> np.ndarray:
        lights = [
            {"type": "directional", "direction": [-1.0, -0.4, -0.3], "color": RED},
            {"type": "directional", "direction": [1.0, 0.7, -0.2], "color": GREEN},
        ]
        node = {
            "mesh": studio.mesh(mesh),
            "transform": {"rotation": turn, "scale": [0.5 * mirror, 0.5, 0.5]},
            "surface": {"technique": "phong", **surface},
        }
        return studio.draw({"camera": CAMERA, "lights": lights, "nodes": [node]}, (48, 48))

    both = drawn(shape, alpha_mode="blend", opacity=0.5)
    front_only = drawn(shape, alpha_mode="blend", opacity=0.5, double_sided=False)

    front = drawn(shape, double_sided=False)
    back = drawn(inside_out, double_sided=False)
    np.testing.assert_allclose(front_only, 0.5 * front, atol=1e-6)
    wrong = np.abs(both - over(0.5 * front, 0.5 * back)).max(axis=2) > 1e-5
    # Sorted triangles are exact where they are small against their distance: not at the outline.
    assert wrong.sum() <= (3 if "sorted" in name else 0)


def test_a_ring_is_seen_four_times_through_itself(studio: Studio) -> None:
    ring = {"type": "torus", "segments": 256, "rings": 128}
    node = {
        "mesh": ring,
        "transform": {"scale": [0.6, 0.6, 0.6]},
        "surface": glass([1.0, 1.0, 1.0], 0.5),
    }

    drawn = studio.draw({"camera": CAMERA, "nodes": [node]}, (64, 64))

    # Seen from the side, a ray through its middle enters and leaves the tube twice.
    assert drawn[32, 32, 3] == pytest.approx(1 - 0.5**4, abs=1e-6)


def test_the_sides_of_a_ring_come_from_back_to_front(studio: Studio) -> None:
    # Green where x is beyond zero, else blue; seen along x from either end.
    halves = studio.texture(np.array([[GREEN, BLUE, BLUE, GREEN]]))
    surface = glass({"texture": halves, "filter": "nearest"})
    ring = {"type": "torus", "segments": 256, "rings": 128}

    def middle(turn: float) -> np.ndarray:
        transform = {"rotation": [0.0, turn, 0.0, 1.0], "scale": [0.6, 0.6, 0.6]}
        node = {"mesh": ring, "transform": transform, "surface": surface}
        return studio.draw({"camera": CAMERA, "nodes": [node]}, (65, 65))[32, 32]

    # Two sides of the near half hide three quarters of those of the far half.
    assert middle(-1.0) == pytest.approx([0.0, 0.75, 0.1875, 0.9375], abs=1e-5)
    assert middle(1.0) == pytest.approx([0.0, 0.1875, 0.75, 0.9375], abs=1e-5)


@pytest.mark.parametrize("mode", ["opaque", "mask", "blend"])
@pytest.mark.parametrize("mirror", [1.0, -1.0])
def test_a_back_is_not_drawn_where_there_is_one_side_only(
    studio: Studio, mode: str, mirror: float
) -> None:
    surface = glass(RED, 1.0, alpha_mode=mode, double_sided=False)
    transform = {"scale": [mirror, 1.0, 1.0]}

    front = studio.poster(surface, transform=transform)
    back = studio.poster(surface, transform=transform | {"rotation": [0.0, 1.0, 0.0, 0.0]})

    assert (front[..., 3] == 1).all()
    assert not back.any()


def test_vertex_colours_let_light_through_too(studio: Studio) -> None:
    colors = np.array([[1.0, 0.5, 0.25, 0.5]] * 4)
    mesh = studio.mesh(replace(plane(2.0, 2.0, "+z"), colors=colors))
    node = {"mesh": mesh, "surface": glass([1.0, 1.0, 1.0], 0.5)}

    drawn = studio.draw({"camera": CAMERA, "nodes": [node]}, (4, 4))

    np.testing.assert_allclose(drawn[2, 2], [0.25, 0.125, 0.0625, 0.25], rtol=1e-6)


def glass_scene(studio: Studio) -> dict[str, Any]:
    """Everything of this module before a picture."""
    leaves = studio.texture(np.random.default_rng(3).random((8, 8)))
    ring = {"type": "torus"}
    return {
        "camera": CAMERA,
        "background": {"texture": studio.texture(np.random.default_rng(2).random((9, 9, 3)))},
        "nodes": [
            poster(0.0, {"technique": "unlit", "color": BLUE}, scale=[0.4, 0.4, 1.0]),
            poster(-1.0, glass(GREEN, {"texture": leaves}, alpha_mode="mask"), scale=[0.9, 0.9, 1]),
            poster(1.0, glass(RED), rotation=[0.3, 0.2, 0.1, 1.0]),
            poster(0.5, glass(GREEN, 0.3), rotation=[-0.3, 0.1, 0.5, 1.0]),
            {
                "mesh": ring,
                "transform": {"scale": [0.5, 0.5, 0.5]},
                "surface": glass([1.0, 1.0, 1.0], 0.2),
            },
        ],
    }


def test_blended_pictures_in_tiles_are_the_picture(
    studio: Studio, monkeypatch: pytest.MonkeyPatch
) -> None:
    from worker.rendering import renderer  # noqa: PLC0415  needs OpenGL

    whole = studio.draw(glass_scene(studio), (90, 70), 2)
    monkeypatch.setattr(renderer, "SAMPLES_MAX", 90 * 4 * 8)

    cut = studio.draw(glass_scene(studio), (90, 70), 2)

    error = np.abs(cut - whole).max(axis=2)
    assert np.median(error) < 1e-6
    assert (error > 1e-3).mean() < 0.01  # samples on an edge, as in an opaque picture


def test_layers_know_what_light_comes_through_but_not_what_it_is(studio: Studio) -> None:
    scene = glass_scene(studio) | {"background": None}
    names = ["coverage", "albedo", "object_id", "depth"]
    solid = scene | {"nodes": scene["nodes"][:2]}

    layers = studio.layers(scene, names, (60, 40), 2)
    behind = studio.layers(solid, names, (60, 40), 2)

    np.testing.assert_allclose(layers["picture"], studio.draw(scene, (60, 40), 2), atol=1e-6)
    np.testing.assert_allclose(layers["coverage"], layers["picture"][..., 3:], atol=1e-6)
    np.testing.assert_allclose(layers["albedo"], layers["picture"], atol=1e-6)  # all is unlit
    np.testing.assert_array_equal(layers["object_id"], behind["object_id"])
    np.testing.assert_array_equal(layers["depth"], behind["depth"])


@pytest.mark.parametrize("bits", [8, 16])
def test_a_png_has_straight_alpha_and_an_exr_premultiplied(
    studio: Studio, tmp_path: Path, bits: Any
) -> None:
    nodes = [poster(0.0, glass([1.0, 0.5, 0.0], 0.5)), poster(1.0, glass([0.0, 0.5, 1.0], 0.5))]
    drawn = Image(studio.draw({"camera": CAMERA, "nodes": nodes}, (4, 4)), "colour")
    png, exr = tmp_path / "p.png", tmp_path / "p.exr"

    image_io.encode_png(drawn, png, bits=bits, transfer="linear")
    image_io.encode_exr({"": drawn}, exr, pixel_type="float", digest="", version="")

    # Over each other: (1, .5, 0) / 4 + (0, .5, 1) / 2, with 3/4 of coverage.
    light = np.array([0.25, 0.375, 0.5])
    stored = image_io.read(png, "linear", "data").pixels
    straight = [*(light / 0.75), 0.75]
    np.testing.assert_allclose(stored[2, 2], straight, atol=0.5 / (2**bits - 1) + 1e-6)
    np.testing.assert_allclose(
        image_io.read(exr, "linear", "data").pixels[2, 2], [*light, 0.75], rtol=1e-6
    )


@pytest.mark.golden
def test_the_window_looks_as_it_did(
    compare_with_golden: Callable[..., None], tmp_path: Path
) -> None:
    path = tmp_path / "picture.exr"

    run_example("window", path, tmp_path / "assets", size=[64, 48], format="exr", exr_type="float")

    compare_with_golden(image_io.read(path, "linear", "colour"), "window/example")
