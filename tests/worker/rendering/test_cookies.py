"""T38, projective textures: each point is lit by the texel that its ray goes through, p = P x.

The slide is linear, red in u and green in v, which bilinear reading reproduces exactly between the
middles of its outermost texels. It falls slantwise on a wall in the plane z = 0.
"""

from typing import Any

import numpy as np
import pytest

from tests.worker.rendering.studio import Pixels, Studio

pytestmark = pytest.mark.gl

SIZE = 96
EXTENT = 4.0
TEXELS = 32
MATT = {"technique": "phong", "diffuse_color": [1.0, 1.0, 1.0]}
SPOT = {
    "type": "spot",
    "position": [1.0, 0.5, 3.0],
    "direction": [-0.4, -0.1, -1.0],
    "intensity": 10.0,
    "inner_angle": 0.5,
    "outer_angle": 0.55,
}
SUN = {"type": "directional", "direction": [-0.4, -0.1, -1.0]}
UP = np.array([0.3, 1.0, 0.2])


def slide(studio: Studio, **more: Any) -> dict[str, Any]:
    ramp = (np.arange(TEXELS) + 0.5) / TEXELS
    pixels = np.zeros((TEXELS, TEXELS, 3))
    pixels[..., 0] = ramp
    pixels[..., 1] = ramp[::-1, None]  # row 0 is the top one
    return {
        "texture": studio.texture(pixels),
        "filter": "bilinear",
        "up": UP.tolist(),
        **more,
    }


def wall(studio: Studio, *lights: dict[str, Any]) -> Pixels:
    return studio.draw(
        {
            "camera": {"type": "orthographic", "height": EXTENT, "pose": {"eye": [0, 0, 5.0]}},
            "lights": list(lights),
            "nodes": [{"mesh": {"type": "plane", "width": 6, "height": 6}, "surface": MATT}],
        },
        (SIZE, SIZE),
    )[..., :3]


def share(studio: Studio, light: dict[str, Any], cookie: dict[str, Any]) -> Pixels:
    """What part of each colour comes through; NaN where the light does not shine."""
    plain = wall(studio, light)
    thrown = wall(studio, light | {"cookie": cookie})
    return np.where(plain > 1e-4, thrown / np.maximum(plain, 1e-30), np.nan)


def seen_from(light: dict[str, Any], up: np.ndarray = UP) -> np.ndarray:
    """Points of the wall in the light's axes: right, up and forward; (SIZE, SIZE, 3)."""
    along = ((np.arange(SIZE) + 0.5) / SIZE - 0.5) * EXTENT
    points = np.stack([*np.meshgrid(along, -along), np.zeros((SIZE, SIZE))], axis=-1)
    forward = np.array(light["direction"]) / np.linalg.norm(light["direction"])
    right = np.cross(forward, up)
    right /= np.linalg.norm(right)
    axes = np.stack([right, np.cross(right, forward), forward])
    return (points - light.get("position", [0.0, 0.0, 0.0])) @ axes.T


def of_spot(aspect: float = 1.0) -> np.ndarray:
    """u and v on a slide whose longer side fills the cone."""
    place = seen_from(SPOT)
    tangents = place[..., :2] / place[..., 2:] / np.tan(0.55)
    return 0.5 + 0.5 * tangents / [min(aspect, 1.0), min(1.0 / aspect, 1.0)]


def compare(seen: Pixels, uv: np.ndarray) -> None:
    margin = 0.5 / TEXELS
    inside = (uv > margin).all(axis=-1) & (uv < 1 - margin).all(axis=-1)
    inside &= ~np.isnan(seen[..., 0])
    assert inside.sum() > 300
    np.testing.assert_allclose(seen[inside][:, :2], uv[inside], atol=2e-4)
    outside = ((uv < -margin) | (uv > 1 + margin)).any(axis=-1) & ~np.isnan(seen[..., 0])
    assert (seen[outside] == 0).all()


@pytest.mark.parametrize("aspect", [1.0, 1.6, 0.5])
def test_t38_a_spot_throws_its_slide_in_perspective(studio: Studio, aspect: float) -> None:
    compare(share(studio, SPOT, slide(studio, aspect=aspect)), of_spot(aspect))


def test_t38_parallel_light_throws_its_gobo_without_perspective(studio: Studio) -> None:
    cookie = slide(studio, width=2.5, height=1.5, centre=[0.5, -0.25, 0.0])
    place = seen_from(SUN | {"position": [0.5, -0.25, 0.0]})

    compare(share(studio, SUN, cookie), 0.5 + place[..., :2] / [2.5, 1.5])


def test_a_slide_is_moved_and_repeated_as_maps_are(studio: Studio) -> None:
    """Scaled, then turned by a quarter, then shifted: (u, v) reads (0.1 - 2 v, 0.2 + 2 u)."""
    moved = {"scale": [2.0, 2.0], "rotation": np.pi / 2, "offset": [0.1, 0.2]}
    wrap = ["repeat", "repeat"]
    seen = share(studio, SPOT, slide(studio, transform=moved, wrap=wrap, filter="nearest"))
    uv = of_spot()
    read = np.stack([0.1 - 2 * uv[..., 1], 0.2 + 2 * uv[..., 0]], axis=-1) * TEXELS
    sure = (abs(read - np.rint(read)) > 0.02).all(axis=-1) & ~np.isnan(seen[..., 0])

    expected = (np.floor(read) % TEXELS + 0.5) / TEXELS
    np.testing.assert_allclose(seen[sure][:, :2], expected[sure], atol=1e-5)


@pytest.mark.parametrize("light", [SPOT, SUN])
def test_a_white_slide_changes_nothing(studio: Studio, light: dict[str, Any]) -> None:
    white = {"texture": studio.texture(np.ones((4, 4, 3))), "wrap": ["clamp", "clamp"]}

    assert wall(studio, light | {"cookie": white}).tobytes() == wall(studio, light).tobytes()


def test_each_light_has_its_own_slide_or_none(studio: Studio) -> None:
    first, second = slide(studio), slide(studio, up=[1.0, 0.0, 0.0])
    other = {"texture": studio.texture([[[0.2, 0.4, 0.6]]]), "wrap": ["clamp", "clamp"]}
    point = {"type": "point", "position": [0.0, 0.0, 2.0]}
    lights = [
        point,
        SPOT | {"cookie": first},
        {"type": "ambient"},
        SUN | {"cookie": other},
        SPOT | {"cookie": second, "shadow": {}},
    ]
    together = wall(studio, *lights)

    each = [wall(studio, light) for light in lights]
    np.testing.assert_allclose(together, np.sum(each, axis=0), rtol=1e-5, atol=1e-6)


def test_a_picture_far_smaller_than_the_pixels_fades_to_its_mean(studio: Studio) -> None:
    checks = studio.texture(np.indices((64, 64)).sum(axis=0) % 2)
    fine = {"texture": checks, "width": 0.02, "height": 0.02, "wrap": ["repeat", "repeat"]}

    np.testing.assert_allclose(share(studio, SUN, fine), 0.5, atol=1e-3)
