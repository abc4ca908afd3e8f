"""T40 and X23: how much of a texture a pixel covers, told as layers."""

from typing import Any

import numpy as np
import pytest

from tests.worker.rendering.studio import Studio

pytestmark = pytest.mark.gl

FOCAL = 100.0


def ground(height: int, surface: dict[str, Any], tile: list[float] | None = None) -> dict[str, Any]:
    """The plane 1 below an eye that looks along it, a focal length of 100 pixels."""
    return {
        "camera": {
            "type": "perspective",
            "fov_y": float(2 * np.arctan(height / 2 / FOCAL)),
            "pose": {"eye": [0.0, 1.0, 0.0], "target": [0.0, 1.0, -1.0]},
        },
        "nodes": [
            {"mesh": {"type": "infinite_plane", "tile": tile or [1.0, 1.0]}, "surface": surface}
        ],
    }


@pytest.mark.parametrize("supersampling", [1, 3])
def test_a16_t40_the_highest_harmonics_of_a_checkerboard(
    studio: Studio, supersampling: int
) -> None:
    # With an odd count the middles of rows lie whole pixels below the horizon: y = f h / z.
    size = (5, 41)
    drawn = studio.layers(ground(41, {"technique": "unlit"}), ["footprint"], size, supersampling)
    rows = 20 + np.array([20, 10, 4, 1])

    right, up = drawn["footprint"][rows, 2, :2], drawn["footprint"][rows, 2, 2:]

    # Of several samples the nearest one tells, the lowest: z = f / (y + 1/3).
    z = FOCAL / (np.array([20, 10, 4, 1]) + (supersampling - 1) / (2 * supersampling))
    np.testing.assert_allclose(1 / abs(right[:, 0]), FOCAL / z, rtol=1e-5)
    np.testing.assert_allclose(1 / abs(up[:, 1]), FOCAL / z**2, rtol=1e-5)
    if supersampling == 1:
        np.testing.assert_allclose(1 / abs(right[:, 0]), [20, 10, 4, 1], rtol=1e-5)
        np.testing.assert_allclose(1 / abs(up[:, 1]), [4, 1, 0.16, 0.01], rtol=1e-5)
    np.testing.assert_allclose(right[:, 1], 0, atol=1e-4)


def test_t40_footprints_are_derivatives_of_uv(studio: Studio) -> None:
    scene = ground(40, {"technique": "unlit"}, [2.0, 0.5])
    scene["camera"]["pose"] = {"eye": [0.3, 1.0, 0.2], "target": [0.6, 0.2, -1.0]}
    one = studio.layers(scene, ["footprint", "uv"], (40, 40))

    # A central difference of 1/16 of a pixel, by a picture of as many more pixels.
    fine = studio.layers(scene, ["uv"], (640, 640))["uv"].astype(float)
    across = [fine[8::16, 9::16] - fine[8::16, 7::16], fine[7::16, 8::16] - fine[9::16, 8::16]]
    expected = np.concatenate(across, axis=2) * 8
    middle = fine[8::16, 8::16] - one["uv"]  # half a fine pixel aside

    assert abs(middle).max() < 0.1
    ground_rows = slice(20, None)
    np.testing.assert_allclose(
        one["footprint"][ground_rows], expected[ground_rows], rtol=0.05, atol=2e-3
    )


@pytest.mark.parametrize(("texels", "scale"), [(64, 1.0), (64, 3.0), (16, 0.25)])
@pytest.mark.parametrize("supersampling", [1, 2])
def test_x23_texels_along_a_pixel(
    studio: Studio, texels: int, scale: float, supersampling: int
) -> None:
    picture = studio.texture(np.ones((texels, 2 * texels)))
    mapped = {"texture": picture, "transform": {"scale": [scale, scale], "rotation": 0.4}}
    surface = {"technique": "phong", "emission": {"texture": studio.texture([[1.0]])}}
    scene = {
        "camera": {"type": "orthographic", "height": 2.0, "pose": {"eye": [0.0, 0.0, 2.0]}},
        "nodes": [{"mesh": {"type": "plane"}, "surface": surface | {"diffuse_color": mapped}}],
    }

    drawn = studio.layers(scene, ["texel_density"], (32, 32), supersampling)

    # The root of the texels in a pixel's area, of the picture of the diffuse colour.
    expected = np.sqrt(texels * 2 * texels) * scale / 32
    np.testing.assert_allclose(drawn["texel_density"], expected, rtol=1e-5)


def test_x23_without_a_picture_there_is_no_density(studio: Studio) -> None:
    drawn = studio.layers(ground(40, {"technique": "phong"}), ["texel_density", "uv"], (40, 40))

    assert (drawn["texel_density"] == 0).all()
    assert (drawn["uv"][21:] != 0).any()


def test_t40_at_the_horizon_and_beyond_footprints_are_numbers(studio: Studio) -> None:
    mapped = {"texture": studio.texture(np.ones((8, 8)))}
    scene = ground(40, {"technique": "unlit", "color": mapped})

    drawn = studio.layers(scene, ["footprint", "texel_density"], (40, 40))

    assert (drawn["footprint"][:20] == 0).all()
    for name in ("footprint", "texel_density"):
        assert np.isfinite(drawn[name]).all()


def test_t43_twice_as_many_texels_as_pixels_keep_more_of_the_finest_wave(studio: Studio) -> None:
    # Bilinear reading keeps sinc^2(f) of a wave of f cycles per texel, the mean over phases. The
    # finest wave that pixels hold has 1/2 cycle per pixel: f = 1/2 at ratio 1, f = 1/4 at ratio 2.
    kept = {}
    for ratio in (1, 2):
        texels = 64 * ratio
        wave = np.cos(2 * np.pi * 32 * (np.arange(texels) + 0.5) / texels + np.pi / 4)
        picture = studio.texture(np.tile(wave, (4, 1)))
        powers = []
        for phase in np.random.default_rng(7).random(32):
            mapped = {
                "texture": picture,
                "filter": "bilinear",
                "transform": {"offset": [phase / texels, 0.0]},
            }
            drawn = studio.poster(
                {"technique": "unlit", "color": mapped, "alpha_mode": "opaque"}, (64, 1)
            )
            powers.append(np.mean(drawn[0, :, 0] ** 2))
        kept[ratio] = np.mean(powers)

    assert kept[2] > 1.5 * kept[1]
