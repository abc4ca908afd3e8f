"""T38, refraction mapping: the surroundings, bent by Snell's law and shared by Fresnel's.

An orthographic eye looks along -z at a ball of radius 1: at (x, y) its normal is (x, y, z).
"""

from typing import Any

import numpy as np
import pytest

from tests.worker.rendering.studio import Pixels, Studio

pytestmark = pytest.mark.gl

SIZE = 64
BALL = {"mesh": {"type": "sphere", "segments": 256, "rings": 128}}


def ball(studio: Studio, surface: dict[str, Any], sky: Any = None, **more: Any) -> Pixels:
    scene = {
        "camera": {"type": "orthographic", "height": 2.0, "pose": {"eye": [0.0, 0.0, 5.0]}},
        "lights": [],
        "nodes": [BALL | {"surface": {"technique": "glass", **surface}}],
    }
    if sky is not None:
        scene["environment"] = {"texture": studio.texture(sky)}
    return studio.draw(scene | more, (SIZE, SIZE))[..., :3]


def normals() -> tuple[Pixels, Pixels]:
    """The ball's normals, and which pixels are not near its rim."""
    along = (np.arange(SIZE) + 0.5) / SIZE * 2 - 1
    x, y = np.meshgrid(along, -along)
    squared = x * x + y * y
    normal = np.stack([x, y, np.sqrt(np.maximum(1 - squared, 0))], axis=-1)
    return normal, squared < 0.85**2


def lit_by_z() -> Pixels:
    """A sky whose light is 1 + z, row by row and column by column (OpenEXR's layout)."""
    height, width = 64, 128
    u = (np.arange(width) + 0.5) / width
    latitude = np.pi * (0.5 - (np.arange(height) + 0.5) / height)
    z = np.cos(latitude)[:, None] * np.cos(2 * np.pi * (0.5 - u))
    return np.repeat((1 + z)[:, :, None], 3, axis=2)


def fresnel(cosine: Any, ior: float) -> Any:
    """By Snell's law and the amplitudes of both polarisations, not as the shader has it."""
    bent = np.sqrt(1 - (1 - cosine**2) / ior**2)
    s = (cosine - ior * bent) / (cosine + ior * bent)
    p = (bent - ior * cosine) / (bent + ior * cosine)
    return (s**2 + p**2) / 2


def test_t38_glass_of_index_1_is_not_there(studio: Studio) -> None:
    sky = lit_by_z()

    seen = ball(studio, {"ior": 1.0}, sky)
    nothing = ball(studio, {"ior": 1.0}, sky, nodes=[])

    np.testing.assert_allclose(seen, nothing, atol=2e-3)


def test_t38_what_is_reflected_and_what_is_bent_add_up(studio: Studio) -> None:
    """Under an even sky glass without colour is invisible, clear or frosted; and colour tints."""
    even = {"lights": [{"type": "ambient", "radiance": [0.7, 0.7, 0.7]}]}
    normal, inside = normals()

    for roughness in (0.0, 0.5):
        seen = ball(studio, {"roughness": roughness}, **even)
        np.testing.assert_allclose(seen[inside], 0.7, rtol=1e-5)
    black = ball(studio, {"color": [0.0, 0.0, 0.0]}, **even)[inside][:, 0]
    np.testing.assert_allclose(black, 0.7 * fresnel(normal[inside][:, 2], 1.5), rtol=3e-3)


@pytest.mark.parametrize("ior", [1.33, 1.5, 2.4])
def test_t38_light_is_bent_by_snells_law(studio: Studio, ior: float) -> None:
    """In a sky of 1 + z a direction d shows 1 + d_z. Head-on, F = ((ior - 1) / (ior + 1))^2."""
    seen = ball(studio, {"ior": ior}, lit_by_z())[..., 0]
    normal, inside = normals()
    cosine = normal[..., 2][inside]
    part = fresnel(cosine, ior)
    sine_bent = np.sqrt(1 - cosine**2) / ior
    cosine_bent = np.sqrt(1 - sine_bent**2)
    # Both directions lie in the plane of normal and view: z of each by angles alone.
    reflected_z = 2 * cosine**2 - 1
    bent_z = -(cosine * cosine_bent + np.sqrt(1 - cosine**2) * sine_bent)

    expected = part * (1 + reflected_z) + (1 - part) * (1 + bent_z)
    np.testing.assert_allclose(seen[inside], expected, atol=4e-3)
    middle = seen[SIZE // 2, SIZE // 2]
    assert middle == pytest.approx(2 * ((ior - 1) / (ior + 1)) ** 2, abs=3e-3)


def test_from_inside_nothing_leaves_beyond_the_critical_angle(studio: Studio) -> None:
    """Looking at the inner side of a pane, turned by more than asin(1 / 1.5) = 41.8 degrees."""
    sky = lit_by_z()

    def pane(degrees: float) -> Any:
        half = np.radians(degrees + 180) / 2
        node = {
            "mesh": {"type": "plane", "width": 9, "height": 9},
            "transform": {"rotation": [0.0, np.sin(half), 0.0, np.cos(half)]},
            "surface": {"technique": "glass"},
        }
        return ball(studio, {}, sky, nodes=[node])[SIZE // 2, SIZE // 2, 0]

    # Reflected, the view along -z turns to the side by twice the angle.
    assert pane(50) == pytest.approx(1 + np.cos(np.radians(100)), abs=5e-3)
    assert pane(0) == pytest.approx(2 * 0.04, abs=3e-3)


def test_a_lamp_shines_in_it(studio: Studio) -> None:
    lamp = [{"type": "directional", "direction": [0.0, 0.0, -1.0]}]

    seen = ball(studio, {"roughness": 0.5}, lights=lamp)[..., 0]

    # Head-on D V n.l F = 0.04 / (4 pi alpha^2), alpha = 0.25.
    assert seen.max() == pytest.approx(0.04 / (4 * np.pi * 0.25**2), rel=0.05)
