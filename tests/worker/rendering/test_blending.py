"""What lets light through, over what is behind it."""

import itertools
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from tests.run_example import run_example
from tests.whole_pictures import encode_exr, encode_png
from tests.worker.rendering.panes import (
    BLUE,
    CAMERA,
    GREEN,
    RED,
    glass,
    glass_scene,
    over,
    poster,
)
from tests.worker.rendering.studio import Studio
from worker.geometry.plane import plane
from worker.images import image_io
from worker.images.image import Image

pytestmark = pytest.mark.gl


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


def test_light_beyond_what_a_picture_holds_is_cut_before_it_is_dimmed(studio: Studio) -> None:
    drawn = studio.poster(glass([1e38, 0.0, 0.0], 0.5))

    np.testing.assert_allclose(drawn[16, 16], [2.5e36, 0.0, 0.0, 0.5], rtol=1e-6)


def test_vertex_colours_let_light_through_too(studio: Studio) -> None:
    colors = np.array([[1.0, 0.5, 0.25, 0.5]] * 4)
    mesh = studio.mesh(replace(plane(2.0, 2.0, "+z"), colors=colors))
    node = {"mesh": mesh, "surface": glass([1.0, 1.0, 1.0], 0.5)}

    drawn = studio.draw({"camera": CAMERA, "nodes": [node]}, (4, 4))

    np.testing.assert_allclose(drawn[2, 2], [0.25, 0.125, 0.0625, 0.25], rtol=1e-6)


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

    encode_png(drawn, png, bits=bits, transfer="linear")
    encode_exr({"": drawn}, exr, pixel_type="float", digest="", version="")

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
