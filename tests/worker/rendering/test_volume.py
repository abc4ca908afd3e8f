"""Clouds in a box against the law of Beer and Lambert, and integrals written down (T44)."""

from typing import Any

import numpy as np
import pytest

from tests.worker.rendering.studio import Pixels, Studio

pytestmark = pytest.mark.gl

STRAIGHT = {"type": "orthographic", "height": 2.0, "pose": {"eye": [0.0, 0.0, 10.0]}}
CONSTANT = {"technique": "constant", "value": 0.4}
SKY = {"type": "ambient", "radiance": [0.2, 0.4, 0.8]}
FROM_THE_EYE = {"type": "directional", "direction": [0.0, 0.0, -1.0], "irradiance": 3.0}
ACROSS = {"type": "directional", "direction": [0.0, -1.0, 0.0], "irradiance": 3.0}


def box(depth: float = 2.0, transform: dict[str, Any] | None = None, **surface: Any) -> Any:
    return {
        "mesh": {"type": "box", "depth": depth},
        "transform": transform or {},
        "surface": {"technique": "volume", **surface},
    }


def noisy_cloud() -> dict[str, Any]:
    """A scene whose picture needs all of the chunk."""
    noise = {"technique": "perlin", "frequency": 3, "octaves": 3}
    return {
        "camera": {"type": "perspective", "pose": {"eye": [2.0, 1.0, 4.0]}},
        "lights": [SKY, ACROSS, {"type": "point", "position": [0.5, 0.2, 0.4], "intensity": 4.0}],
        "nodes": [box(density={"texture": noise}, extinction=5.0, anisotropy=0.4)],
    }


def cloud(studio: Studio, node: dict[str, Any], side: int = 6, **scene: Any) -> Any:
    body = {"camera": STRAIGHT, "lights": [], "nodes": [node], **scene}
    return studio.draw(body, (side, side)).astype(np.float64)


@pytest.mark.parametrize("steps", [1, 7, 64])
@pytest.mark.parametrize("extinction", [0.0, 0.5, 3.0, 40.0])
@pytest.mark.parametrize(
    "density", [0.4, {"texture": CONSTANT}, {"texture": CONSTANT, "filter": "formula"}]
)
def test_t44_a_constant_density_lets_through_exp_of_less_sigma_l(
    studio: Studio, density: Any, extinction: float, steps: int
) -> None:
    node = box(3.0, density=density, extinction=extinction, steps=steps)

    seen = cloud(studio, node, background=[1.0, 2.0, 0.25])

    left = np.exp(-0.4 * extinction * 3)
    np.testing.assert_allclose(
        seen[..., :3], np.multiply([1, 2, 0.25], left) + 0 * seen[..., :3], atol=1e-5
    )


def test_t44_without_anything_behind_alpha_is_what_is_hidden(studio: Studio) -> None:
    seen = cloud(studio, box(extinction=0.7))

    np.testing.assert_allclose(seen[..., 3], 1 - np.exp(-1.4), atol=1e-5)


def slabs(origin: Any, ways: Any, low: Any, high: Any) -> Any:
    """Lengths of rays within a box, of which some start inside."""
    with np.errstate(divide="ignore"):
        first, last = (low - origin) / ways, (high - origin) / ways
    entry = np.maximum(np.minimum(first, last).max(axis=-1), 0)
    return np.maximum(np.maximum(first, last).min(axis=-1) - entry, 0)


@pytest.mark.parametrize(
    "eye", [[3.0, 2.0, 4.0], [-0.5, 5.0, 0.3], [0.3, -0.4, 0.5]], ids=["front", "above", "inside"]
)
def test_t44_slanting_rays_are_as_long_as_geometry_says(studio: Studio, eye: Any) -> None:
    # Turned by a quarter round y and stretched: an ellipse would tell lengths of frames apart
    half = np.sqrt(0.5)
    placed = {"scale": [1.5, 0.8, 0.6], "rotation": [0.0, half, 0.0, half]}
    camera = {"type": "perspective", "fov_y": 0.9, "pose": {"eye": eye, "target": [0.1, 0.0, 0.0]}}
    side = 48

    seen = studio.draw(
        {
            "camera": camera,
            "lights": [],
            "nodes": [box(2.0, placed, extinction=0.9, steps=3)],
        },
        (side, side),
    )[..., 3]

    back = np.array(eye) - [0.1, 0.0, 0.0]
    back /= np.linalg.norm(back)
    right = np.cross([0.0, 1.0, 0.0], back)
    right /= np.linalg.norm(right)
    up = np.cross(back, right)
    along = ((np.arange(side) + 0.5) / side * 2 - 1) * np.tan(0.45)
    x, y = np.meshgrid(along, -along)
    ways = x[..., None] * right + y[..., None] * up - back
    ways /= np.linalg.norm(ways, axis=-1, keepdims=True)
    # What was along x lies along -z, and what was along z along x
    high = np.array([0.6, 0.8, 1.5])
    lengths = slabs(np.array(eye), ways, -high, high)
    # Within a pixel of an edge the ray may be another's
    sure = (lengths > 0.05) if min(np.abs(eye) - high) > 0 or max(np.abs(eye) - high) > 0 else True
    expected = 1 - np.exp(-0.9 * lengths)
    assert (np.abs(seen - expected)[np.broadcast_to(sure, seen.shape)] < 1e-4).all()
    assert (seen[lengths == 0] < 1e-4).all()
    assert seen.max() > 0.5


def test_density_is_read_along_the_ray(studio: Studio) -> None:
    # Half and half a cosine along z, over whole periods: its mean
    waves = {"technique": "gardner", "waves": [{"cycles": [0, 0, 3], "phase": 0.7}]}
    density = {"texture": waves, "filter": "formula"}

    whole = cloud(studio, box(2.0, density=density, extinction=0.8))
    part = cloud(studio, box(0.25, density=density, extinction=0.8))

    np.testing.assert_allclose(whole[..., 3], 1 - np.exp(-0.8), atol=2e-4)
    angles = 2 * np.pi * 3 * np.array([-0.125, 0.125]) + 0.7
    inside = 0.5 * 0.25 + 0.5 * np.diff(np.sin(angles))[0] / (2 * np.pi * 3)
    np.testing.assert_allclose(part[..., 3], 1 - np.exp(-0.8 * inside), atol=2e-4)


def test_a_volume_of_texels_is_read_like_the_formula(studio: Studio) -> None:
    waves = {"technique": "gardner", "frequency": 1, "bandwidth": 1, "count": 4}
    turned = {"rotation": [0.2, 0.3, 0.1, 0.9]}

    def seen(filter_name: str) -> Pixels:
        density = {"texture": waves, "filter": filter_name}
        node = box(2.0, turned, density=density, extinction=2.0, steps=128)
        return cloud(studio, node, side=64)[..., 3]

    # The formula is the mean over a pixel, 1/32: a sinc of 2 swings takes (pi / 16)^2 / 6 = .6 %
    np.testing.assert_allclose(seen("bilinear"), seen("formula"), atol=5e-3)
    assert np.ptp(seen("formula")) > 0.05


def test_what_glows_is_as_bright_as_it_hides(studio: Studio) -> None:
    seen = cloud(studio, box(emission=[1.0, 4.0, 0.5], extinction=0.6, color=[0.0] * 3))

    expected = (1 - np.exp(-1.2)) * np.array([1, 4, 0.5])
    np.testing.assert_allclose(seen[..., :3], expected + 0 * seen[..., :3], rtol=1e-5)


def test_light_from_everywhere_is_scattered_by_the_colour(studio: Studio) -> None:
    seen = cloud(studio, box(color=[1.0, 0.5, 0.25], extinction=0.6), lights=[SKY])

    expected = (1 - np.exp(-1.2)) * np.array([0.2, 0.2, 0.2])
    np.testing.assert_allclose(seen[..., :3], expected + 0 * seen[..., :3], rtol=1e-5)


def test_an_even_sky_shines_from_everywhere(studio: Studio) -> None:
    sky = {"texture": studio.texture(np.full((32, 64, 3), 0.7)), "visible": False}

    seen = cloud(studio, box(color=[1.0, 0.5, 0.25], extinction=0.6), environment=sky)

    expected = (1 - np.exp(-1.2)) * 0.7 * np.array([1, 0.5, 0.25])
    np.testing.assert_allclose(seen[..., :3], expected + 0 * seen[..., :3], rtol=2e-3)


def test_a_lamp_within_is_dimmed_only_by_what_is_before_it(studio: Studio) -> None:
    lamp = {"type": "point", "position": [0.5, 0.2, 0.0], "intensity": 2.0}

    seen = cloud(studio, box(steps=256, light_steps=1), lights=[lamp])[..., 0]

    along = (np.arange(6) + 0.5) / 3 - 1
    x, y = np.meshgrid(along, -along)
    t = (np.arange(4096) + 0.5) / 2048
    squared = (x - 0.5)[..., None] ** 2 + (y - 0.2)[..., None] ** 2 + (1 - t) ** 2
    arrives = np.exp(-np.sqrt(squared)) / squared
    expected = 2 / (4 * np.pi) * (np.exp(-t) * arrives).sum(axis=-1) / 2048
    np.testing.assert_allclose(seen, expected, rtol=2e-3)


@pytest.mark.parametrize(
    ("light_steps", "expected"),
    [
        # int_0^tau exp(-t) dt, and exp(-2 t) where the way in is as long as the way out
        (0, 1 - np.exp(-2.0)),
        (4, (1 - np.exp(-4.0)) / 2),
    ],
)
def test_light_is_scattered_once_and_weakened_on_its_way_in(
    studio: Studio, light_steps: int, expected: float
) -> None:
    node = box(extinction=1.0, light_steps=light_steps, steps=128)

    seen = cloud(studio, node, lights=[FROM_THE_EYE])

    # Light is looked at in the middle of steps of 1/64: (1/64)^2 / 24 of it
    np.testing.assert_allclose(seen[..., :3], 3 / (4 * np.pi) * expected, rtol=1e-4)


def test_what_lies_deeper_below_the_light_is_darker(studio: Studio) -> None:
    seen = cloud(studio, box(extinction=1.5, steps=8), lights=[ACROSS])[..., 0]

    # From the top each row is a third of the box deeper; in equal light of the same thickness
    down = (np.arange(6) + 0.5) / 6 * 2
    expected = 3 / (4 * np.pi) * (1 - np.exp(-3.0)) * np.exp(-1.5 * down)
    np.testing.assert_allclose(seen, np.tile(expected[:, None], (1, 6)), rtol=1e-4)


@pytest.mark.parametrize("g", [0.0, 0.6, -0.4])
def test_henyey_and_greenstein_say_where_light_goes(studio: Studio, g: float) -> None:
    def lit_from(direction: list[float]) -> float:
        light = {"type": "directional", "direction": direction, "irradiance": 1.0}
        node = box(extinction=0.5, anisotropy=g, light_steps=0)
        return float(cloud(studio, node, lights=[light])[3, 4, 0] / (1 - np.exp(-1.0)))

    # On: the light shines towards the eye; back: away from it; aside: at right angles
    expected = [
        (1 - g * g) / (4 * np.pi * (1 + g * g - 2 * g * cosine) ** 1.5) for cosine in (1, -1, 0)
    ]
    found = [lit_from(way) for way in ([0.0, 0.0, 1.0], [0.0, 0.0, -1.0], [1.0, 0.0, 0.0])]
    assert found == pytest.approx(expected, rel=1e-4)


def test_a_cloud_lies_over_what_is_behind_it_and_keeps_no_light_away(studio: Studio) -> None:
    wall = {
        "mesh": {"type": "plane", "width": 4.0, "height": 4.0},
        "transform": {"translation": [0.0, 0.0, -2.0]},
        "surface": {"technique": "phong", "diffuse_color": [1.0, 1.0, 1.0]},
    }
    sun = FROM_THE_EYE | {"shadow": {}}

    alone = cloud(studio, wall, lights=[sun])
    behind = cloud(
        studio,
        box(extinction=0.5, color=[0.0] * 3),
        nodes=[wall, box(extinction=0.5, color=[0.0] * 3)],
        lights=[sun],
    )
    before = cloud(
        studio,
        wall,
        nodes=[box(extinction=0.5, transform={"translation": [0.0, 0.0, -4.0]}), wall],
        lights=[sun],
    )

    np.testing.assert_allclose(behind[..., :3], alone[..., :3] * np.exp(-1.0), rtol=1e-4)
    np.testing.assert_array_equal(before, alone)


def test_what_stands_before_a_lamp_throws_its_shadow_through_a_cloud(studio: Studio) -> None:
    roof = {
        "mesh": {"type": "plane", "width": 20.0, "height": 20.0, "facing": "+y"},
        "transform": {"translation": [-10.0, 3.0, 0.0]},
    }
    sun = ACROSS | {"shadow": {"radius": 0}}

    seen = cloud(studio, roof, nodes=[roof, box(extinction=0.5, light_steps=0)], lights=[sun])
    free = cloud(studio, box(extinction=0.5, light_steps=0), lights=[sun])

    np.testing.assert_array_equal(seen[:, :3, :3], 0)
    np.testing.assert_allclose(seen[:, 5:], free[:, 5:], rtol=1e-6)


@pytest.mark.parametrize("value", [np.nan, -1.0, -np.inf])
def test_what_is_no_density_is_nothing(studio: Studio, value: float) -> None:
    texture = studio.texture(np.full((4, 4), value))
    density = {"texture": texture, "filter": "nearest", "coordinates": {"technique": "uv"}}

    seen = cloud(studio, box(density=density), background=[0.5, 0.5, 0.5])

    np.testing.assert_allclose(seen[..., :3], 0.5, atol=1e-6)


def test_the_thickest_cloud_is_a_wall(studio: Studio) -> None:
    node = box(density=3e38, extinction=3e38, emission=[0.5, 0.5, 0.5])

    seen = cloud(studio, node, lights=[FROM_THE_EYE, SKY], background=[7.0, 7.0, 7.0])

    assert np.isfinite(seen).all()
    assert seen[..., 0].max() < 2
