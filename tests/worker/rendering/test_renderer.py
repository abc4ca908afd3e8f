"""The picture as a whole: tiles, samples, alpha, facts, errors."""

import threading
from typing import Any

import numpy as np
import pytest

from tests.worker.rendering.studio import Studio
from worker.errors import RenderError

pytestmark = pytest.mark.gl


def still_life(studio: Studio) -> dict[str, Any]:
    """Curved and slanted things with a sharp texture and a highlight."""
    picture = studio.texture(np.random.default_rng(4).random((32, 32, 3)))
    return {
        "camera": {
            "type": "perspective",
            "pose": {"eye": [2.0, 1.5, 3.0], "target": [0.0, 0.2, 0.0]},
        },
        "lights": [{"type": "directional", "direction": [-1.0, -1.0, -0.5]}],
        "nodes": [
            {
                "mesh": {"type": "sphere"},
                "surface": {
                    "technique": "phong",
                    "diffuse_color": {"texture": picture},
                    "specular_weight": 0.5,
                },
            },
            {
                "mesh": {"type": "plane", "facing": "+y", "width": 20.0, "height": 20.0},
                "transform": {"translation": [0.0, -1.0, 0.0]},
                "surface": {
                    "technique": "unlit",
                    "color": {"texture": picture, "transform": {"scale": [5.0, 5.0]}},
                },
            },
        ],
    }


@pytest.mark.parametrize("supersampling", [1, 3])
def test_a_picture_in_tiles_is_the_picture(
    studio: Studio, monkeypatch: pytest.MonkeyPatch, supersampling: int
) -> None:
    from worker.rendering import renderer  # noqa: PLC0415  needs OpenGL

    scene = still_life(studio)
    whole = studio.draw(scene, (150, 110), supersampling)
    monkeypatch.setattr(renderer, "tile_size", lambda *picture: (64, 64))

    cut = studio.draw(scene, (150, 110), supersampling)

    # A tile's clip coordinates are rounded anew, by 2^-24 of the picture; a corner on the grid of
    # 1/256 pixel may then fall to the next point, and an edge shows or hides a sample.
    error = np.abs(cut - whole).max(axis=2)
    assert np.median(error) < 1e-6
    assert (error > 1e-3).mean() < 0.005


def test_a_sample_is_a_pixel_of_the_larger_picture(studio: Studio) -> None:
    scene = still_life(studio)

    resolved = studio.draw(scene, (40, 30), 4)
    large = studio.draw(scene, (160, 120), 1)

    mean = large.reshape(30, 4, 40, 4, 4).astype(np.float64).mean(axis=(1, 3))
    np.testing.assert_allclose(resolved, mean, atol=2e-6)


def test_where_nothing_is_all_four_are_zero(studio: Studio) -> None:
    drawn = studio.draw(
        {"camera": {"type": "perspective", "pose": {"eye": [0.0, 0.0, 2.0]}}, "nodes": []}
    )

    assert not drawn.any()


def test_an_edge_is_premultiplied(studio: Studio) -> None:
    drawn = studio.draw(
        {
            "camera": {"type": "orthographic", "height": 4.0, "pose": {"eye": [0.0, 0.0, 2.0]}},
            "nodes": [
                {
                    "mesh": {"type": "disk"},
                    "surface": {"technique": "unlit", "color": [4.0, 2.0, 1.0]},
                }
            ],
        },
        (64, 64),
        4,
    )

    alpha = drawn[..., 3]
    np.testing.assert_array_equal(drawn[..., :3], alpha[..., None] * [4, 2, 1])
    assert set(np.unique(alpha * 16)) <= set(range(17))
    assert len(np.unique(alpha)) > 5
    # A polygon of 64 corners; its eight equal eighths share the error of counting points.
    area = 32 * np.sin(2 * np.pi / 64)
    assert alpha.sum() * (4 / 64) ** 2 == pytest.approx(area, rel=5e-3)


def test_emission_of_four_is_four(studio: Studio) -> None:
    drawn = studio.poster({"technique": "unlit", "color": [4.0, 4.0, 4.0]}, supersampling=3)

    assert (drawn[..., :3] == 4).all()
    assert (drawn[..., 3] == 1).all()


def test_the_same_request_gives_the_same_bytes_after_others(studio: Studio) -> None:
    scene = still_life(studio)
    first = studio.draw(scene, (60, 50), 2)
    studio.draw(scene, (33, 77), 1)

    assert studio.draw(scene, (60, 50), 2).tobytes() == first.tobytes()


def test_facts_and_reports(studio: Studio) -> None:
    studio.draw(still_life(studio))

    assert studio.facts["triangles"] == 3968 + 2
    assert studio.facts["texels"] == 32 * 32
    assert studio.facts["draw_ms"] > 0
    assert studio.facts["jit_ms"] >= 0
    fractions = [fraction for fraction, _ in studio.reports]
    assert fractions == sorted(fractions)
    assert (fractions[0], fractions[-1]) == (0.0, 1.0)


def test_another_thread_may_not_draw(studio: Studio) -> None:
    caught: list[BaseException] = []

    def elsewhere() -> None:
        try:
            studio.poster({"technique": "unlit"})
        except RenderError as error:
            caught.append(error)

    studio.poster({"technique": "unlit"})
    thread = threading.Thread(target=elsewhere)
    thread.start()
    thread.join()

    assert "thread" in str(caught[0])


@pytest.mark.parametrize(
    ("scene", "code"),
    [
        ({"pose": {"eye": [0.0, 1.0, 0.0]}}, "camera_degenerate"),
        ({"pose": {"eye": [0.0, 0.0, 1.0], "target": [0.0, 0.0, 1.0]}}, "camera_degenerate"),
    ],
    ids=["along up", "eye is target"],
)
def test_a_bad_camera_is_named_and_the_next_picture_is_good(
    studio: Studio, scene: dict[str, Any], code: str
) -> None:
    with pytest.raises(RenderError) as caught:
        studio.draw({"camera": {"type": "perspective", **scene}, "nodes": []})

    assert caught.value.code == code
    assert studio.poster({"technique": "unlit"}).min() == 1


def test_flat_and_sheared_transforms_are_drawn(studio: Studio) -> None:
    flat = np.diag([1.0, 1.0, 0.0, 1.0])
    flat[0, 1] = 0.5

    drawn = studio.poster(
        {"technique": "phong"},
        transform={"matrix": flat.T.ravel().tolist()},
        lights=[{"type": "directional", "direction": [0.0, 0.0, -1.0]}],
    )

    assert np.isfinite(drawn).all()
    assert drawn[16, 16, 0] == np.float32(0.8)


def test_warm_draws_every_surface_and_leaves_nothing_to_compile(studio: Studio) -> None:
    from worker.rendering.renderer import warm  # noqa: PLC0415  needs OpenGL

    reports: list[float] = []
    warm(lambda fraction, stage: reports.append(fraction), studio.maker)

    studio.poster({"technique": "phong"})
    assert studio.facts["jit_ms"] == 0
    assert reports[-1] == 1.0
