"""How samples become pixels, against the weights by their definition."""

import json
from collections.abc import Iterator
from typing import Any

import numpy as np
import pytest

from api_schemas.output import RenderOutput
from api_schemas.scene import Scene
from tests.worker.rendering.studio import Studio

pytestmark = pytest.mark.gl

SIZE = (14, 10)
WINDOWS = {
    "box": lambda d: (abs(d) < 0.5) * 1.0,
    "tent": lambda d: np.clip(1 - abs(d), 0, None),
    "gaussian": lambda d: np.exp(-2 * d * d) * (abs(d) < 1.5),
}


def draw(studio: Studio, scene: dict[str, Any], **output: Any) -> dict[str, np.ndarray]:
    def bands() -> Iterator[Any]:
        yield from studio._render(
            Scene.model_validate_json(json.dumps(scene)),
            RenderOutput(**{"size": list(SIZE), **output}),
            studio.make,
            lambda mesh: studio.models[mesh.asset],
            lambda fraction, stage: None,
        ).bands

    parts = list(bands())
    return {name: np.concatenate([part[name].pixels for part in parts]) for name in parts[0]}


def scene_of(studio: Studio) -> dict[str, Any]:
    """A plane of hard texels, 15 along a pixel; it goes on beyond the edges."""
    noise = np.random.default_rng(1).random((15 * 20, 15 * 24, 3))
    mapped = {"texture": studio.texture(noise), "filter": "nearest"}
    return {
        "camera": {
            "type": "orthographic",
            "height": 10.0,
            "pose": {"eye": [12.0, 10.0, 5.0], "target": [12.0, 10.0, 0.0]},
        },
        "nodes": [
            {
                "mesh": {"type": "infinite_plane", "facing": "+z", "tile": [24.0, 20.0]},
                "surface": {"technique": "unlit", "color": mapped},
            }
        ],
    }


@pytest.mark.parametrize("pixel_filter", ["box", "tent", "gaussian"])
@pytest.mark.parametrize("supersampling", [1, 3, 5])
@pytest.mark.parametrize("layers", [[], ["albedo", "coverage", "depth"]], ids=["alone", "layers"])
def test_each_sample_counts_by_its_distance(
    studio: Studio, pixel_filter: str, supersampling: int, layers: list[str]
) -> None:
    scene = scene_of(studio)
    texels = next(iter(studio._arrays.values()))[::-1].astype(float)
    # Pixel (x, y) begins with texel 15 (5 + x), 15 (5 + y) from the lower left; of 1, 3 or 5
    # samples each lies in the middle of a texel.
    s = supersampling
    near = (np.arange(3 * s) + 0.5) / s - 1.5
    weight = WINDOWS[pixel_filter](near)
    weight /= weight.sum()
    places = np.floor((np.arange(-s, (max(SIZE) + 1) * s) + 0.5) / s * 15).astype(int)
    expected = np.zeros((SIZE[1], SIZE[0], 3))
    for y in range(SIZE[1]):
        for x in range(SIZE[0]):
            rows = places[y * s : (y + 3) * s] + 75
            columns = places[x * s : (x + 3) * s] + 75
            block = texels[np.ix_(rows, columns)]
            expected[SIZE[1] - 1 - y, x] = np.einsum("y,x,yxc->c", weight, weight, block)

    drawn = draw(
        studio, scene, supersampling=supersampling, pixel_filter=pixel_filter, layers=layers
    )

    np.testing.assert_allclose(drawn["picture"][..., :3], expected, atol=2e-6)
    np.testing.assert_allclose(drawn["picture"][..., 3], 1, atol=1e-6)
    if layers:
        np.testing.assert_allclose(drawn["albedo"][..., :3], expected, atol=2e-6)
        np.testing.assert_allclose(drawn["coverage"], 1, atol=1e-6)
        np.testing.assert_allclose(drawn["depth"], 5, rtol=1e-6)


@pytest.mark.parametrize("pixel_filter", ["tent", "gaussian"])
def test_an_edge_is_softer_and_its_coverage_follows(studio: Studio, pixel_filter: str) -> None:
    # The edge of an opaque half plane through the middle of a pixel: the window's integral.
    scene = {
        "camera": {"type": "orthographic", "height": 10.0, "pose": {"eye": [0.0, 0.0, 5.0]}},
        "nodes": [
            {
                "mesh": {"type": "plane", "width": 100.0, "height": 100.0},
                "transform": {"translation": [50.5, 0.0, 0.0]},
                "surface": {"technique": "unlit"},
            }
        ],
    }
    fine = np.linspace(-2, 2, 400001)
    window = WINDOWS[pixel_filter](fine)
    right = np.cumsum(window[::-1])[::-1] / window.sum()
    # Middles of pixels lie at half units; the edge is at x = 0.5.
    expected = [np.interp(0.5 - x, fine, right) for x in np.arange(SIZE[0]) - 6.5]

    drawn = draw(studio, scene, supersampling=8, pixel_filter=pixel_filter)

    np.testing.assert_allclose(drawn["picture"][5, :, 3], expected, atol=0.01)
    np.testing.assert_allclose(drawn["picture"][..., 0], drawn["picture"][..., 3], atol=1e-6)


@pytest.mark.parametrize("pixel_filter", ["tent", "gaussian"])
@pytest.mark.parametrize("layers", [[], ["depth", "albedo"]], ids=["alone", "layers"])
def test_tiles_join_without_a_seam(
    studio: Studio, monkeypatch: pytest.MonkeyPatch, pixel_filter: str, layers: list[str]
) -> None:
    from worker.rendering import renderer  # noqa: PLC0415  needs OpenGL

    output = {"supersampling": 2, "pixel_filter": pixel_filter, "layers": layers}
    whole = draw(studio, scene_of(studio), **output)
    for name in ("SAMPLES_MAX", "LAYERED_SAMPLES_MAX"):
        monkeypatch.setattr(renderer, name, 4 * 16 * 6)

    in_tiles = draw(studio, scene_of(studio), **output)

    for name, pixels in whole.items():
        np.testing.assert_allclose(in_tiles[name], pixels, atol=1e-6)


def test_a_background_goes_on_beyond_the_edges(studio: Studio) -> None:
    scene = {
        "camera": {"type": "orthographic", "height": 10.0, "pose": {"eye": [0.0, 0.0, 5.0]}},
        "background": {"texture": studio.texture(np.full((4, 4, 3), 0.7)), "wrap": ["clamp"] * 2},
        "nodes": [],
    }
    for pixel_filter in ("tent", "gaussian"):
        drawn = draw(studio, scene, supersampling=2, pixel_filter=pixel_filter)

        np.testing.assert_allclose(drawn["picture"][..., :3], 0.7, atol=1e-6)
