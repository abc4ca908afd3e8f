"""What is seen where nothing is."""

from typing import Any

import numpy as np
import pytest

from tests.worker.rendering.studio import Studio

pytestmark = pytest.mark.gl

CAMERA = {"type": "orthographic", "height": 2.0, "pose": {"eye": [0.0, 0.0, 10.0]}}
PICTURE = np.random.default_rng(7).random((24, 40, 3), dtype=np.float32)


def draw(
    studio: Studio,
    background: Any,
    nodes: list[dict[str, Any]] | None = None,
    size: tuple[int, int] = (40, 24),
    supersampling: int = 1,
) -> np.ndarray:
    scene = {"camera": CAMERA, "background": background, "nodes": nodes or []}
    return studio.draw(scene, size, supersampling)


def disc(**surface: Any) -> dict[str, Any]:
    surface = {"technique": "unlit", "color": [4.0, 0.0, 0.0], **surface}
    return {"mesh": {"type": "disk", "radius": 0.5}, "surface": surface}


def test_a_colour_is_everywhere_and_opaque(studio: Studio) -> None:
    assert (draw(studio, [4.0, 0.5, 0.25]) == np.array([4.0, 0.5, 0.25, 1.0])).all()


def test_the_brightest_colour_is_what_a_picture_holds(studio: Studio) -> None:
    drawn = draw(studio, [3e38, 0.0, 1.0], supersampling=8)

    np.testing.assert_allclose(drawn, np.broadcast_to([5e36, 0.0, 1.0, 1.0], drawn.shape), 1e-6)


@pytest.mark.parametrize("supersampling", [1, 2, 5])
def test_a_picture_of_the_same_size_is_seen_as_it_is(studio: Studio, supersampling: int) -> None:
    nearest, smooth = (
        draw(
            studio,
            {"texture": studio.texture(PICTURE), "filter": name},
            None,
            (40, 24),
            supersampling,
        )
        for name in ("nearest", "anisotropic")
    )

    np.testing.assert_allclose(nearest[..., :3], PICTURE, rtol=1e-6)
    # Coordinates are rounded to 2^-24: a few millionths of a texel.
    np.testing.assert_allclose(smooth[..., :3], PICTURE, atol=2e-5)
    assert (nearest[..., 3] == 1).all()
    assert (smooth[..., 3] == 1).all()


@pytest.mark.parametrize("supersampling", [1, 2])
def test_half_a_picture_is_the_mean_of_four_texels(studio: Studio, supersampling: int) -> None:
    mapped = {"texture": studio.texture(PICTURE)}
    half = draw(studio, mapped, size=(20, 12), supersampling=supersampling)

    mean = PICTURE.reshape(12, 2, 20, 2, 3).mean(axis=(1, 3))
    np.testing.assert_allclose(half[..., :3], mean, atol=2e-5)


def test_a_minified_picture_is_filtered(studio: Studio) -> None:
    checkers = np.indices((256, 256)).sum(axis=0) % 2

    tiny = draw(studio, {"texture": studio.texture(checkers)}, size=(32, 32))

    np.testing.assert_allclose(tiny[..., :3], 0.5, atol=1e-6)


def test_maps_are_maps(studio: Studio) -> None:
    mapped = {
        "texture": studio.texture(PICTURE),
        "filter": "nearest",
        "transform": {"scale": [2.0, 1.0], "offset": [0.5, 0.0]},
        "wrap": ["mirror", "repeat"],
        "scale": 2.0,
        "bias": 0.25,
        "tint": [1.0, 0.5, 0.0],
    }

    drawn = draw(studio, mapped, size=(80, 24))

    twice = np.concatenate([PICTURE, PICTURE[:, ::-1]], axis=1)
    seen = np.roll(twice, -20, axis=1) * [2.0, 1.0, 0.0] + 0.25
    np.testing.assert_allclose(drawn[..., :3], seen, atol=1e-6)


def test_coverage_of_a_picture_leaves_the_rest_transparent(studio: Studio) -> None:
    pixels = np.concatenate([0.5 * PICTURE, np.full((24, 40, 1), 0.5, np.float32)], axis=2)
    mapped = {"texture": studio.texture(pixels), "filter": "nearest"}

    drawn = draw(studio, mapped, [disc(alpha_mode="blend", opacity=0.5)])

    np.testing.assert_array_equal(drawn[0], pixels[0])
    np.testing.assert_allclose(
        drawn[12, 20], 0.5 * pixels[12, 20] + [2.0, 0.0, 0.0, 0.5], rtol=1e-6
    )


def test_things_are_before_it_and_what_they_do_not_cover_is_exact(studio: Studio) -> None:
    mapped = {"texture": studio.texture(PICTURE), "filter": "nearest"}
    behind = [disc() | {"transform": {"translation": [0.0, 0.0, -900.0]}}]

    for nodes in ([disc()], behind):
        drawn = draw(studio, mapped, nodes)
        alone = draw(studio, None, nodes)

        covered = alone[..., 3] > 0
        assert 0 < covered.sum() < covered.size
        assert (drawn[covered] == np.array([4.0, 0.0, 0.0, 1.0])).all()
        np.testing.assert_array_equal(drawn[~covered][:, :3], PICTURE[~covered])


def test_edges_lie_over_it_by_their_coverage(studio: Studio) -> None:
    alone = draw(studio, None, [disc()], supersampling=4)
    drawn = draw(studio, [0.0, 1.0, 0.0], [disc()], supersampling=4)

    expected = alone + [0.0, 1.0, 0.0, 1.0] * (1 - alone[..., 3:])
    np.testing.assert_allclose(drawn, expected, atol=1e-6)


@pytest.mark.parametrize("supersampling", [1, 3])
def test_in_tiles_it_is_the_same_to_the_bit(
    studio: Studio, monkeypatch: pytest.MonkeyPatch, supersampling: int
) -> None:
    from worker.rendering import renderer  # noqa: PLC0415  needs OpenGL

    mapped = {"texture": studio.texture(PICTURE), "transform": {"rotation": 0.4}}
    whole = draw(studio, mapped, size=(90, 70), supersampling=supersampling)
    monkeypatch.setattr(renderer, "SAMPLES_MAX", 90 * supersampling**2 * 8)

    cut = draw(studio, mapped, size=(90, 70), supersampling=supersampling)

    assert cut.tobytes() == whole.tobytes()


def test_layers_know_nothing_of_it(studio: Studio) -> None:
    names = ["depth", "object_id", "coverage", "albedo"]
    mapped = {"texture": studio.texture(PICTURE)}

    def layers(background: Any) -> dict[str, np.ndarray]:
        scene = {"camera": CAMERA, "background": background, "nodes": [disc()]}
        return studio.layers(scene, names, (40, 24), 2)

    none, colour, picture = (layers(background) for background in (None, [1.0, 1, 1], mapped))
    for name in names:
        np.testing.assert_array_equal(colour[name], none[name])
        np.testing.assert_array_equal(picture[name], none[name])
    assert (picture["picture"][..., 3] == 1).all()
