"""metallic_roughness with anisotropy (T65), against the text of KHR_materials_anisotropy."""

from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from tests.worker.rendering.studio import Studio
from tests.worker.rendering.surroundings import latlong

pytestmark = pytest.mark.gl

Floats = NDArray[np.float64]
NORMAL = np.array([0.0, 0.0, 1.0])
METAL: dict[str, Any] = {"technique": "metallic_roughness", "base_color": [0.9, 0.6, 0.2]}
WHITE: dict[str, Any] = {"technique": "metallic_roughness"}
WHITE_SKY = {"type": "ambient", "radiance": [1.0, 1.0, 1.0]}


def unit(vector: Any) -> Floats:
    return np.asarray(vector, dtype=np.float64) / np.linalg.norm(vector)


def seen(studio: Studio, surface: dict[str, Any], view: Floats, **scene: Any) -> Floats:
    """One colour of a square in the plane of x and y, u along x, that fills the picture."""
    drawn = studio.draw(
        {
            "camera": {"type": "orthographic", "height": 0.02, "pose": {"eye": list(3 * view)}},
            "lights": [],
            "nodes": [{"mesh": {"type": "plane"}, "surface": surface}],
            **scene,
        },
        (2, 2),
    )
    return drawn[0, 0, :3].astype(np.float64)


def lit(studio: Studio, surface: dict[str, Any], view: Floats, light: Floats) -> Floats:
    lamp = {"type": "directional", "direction": list(-light)}
    return seen(studio, surface, view, lights=[lamp])


def lobe(
    view: Floats, light: Floats, alpha: float, strength: float, direction: float
) -> NDArray[np.float64]:
    """D V of the extension's appendix; `light` may be many (..., 3)."""
    t = np.array([np.cos(direction), np.sin(direction), 0.0])
    b = np.cross(NORMAL, t)
    h = view + light
    h /= np.linalg.norm(h, axis=-1, keepdims=True)
    at, ab = alpha * (1 - strength**2) + strength**2, alpha
    a2 = at * ab
    f = np.stack([ab * (h @ t), at * (h @ b), a2 * (h @ NORMAL)], axis=-1)
    w2 = a2 / (f * f).sum(axis=-1)
    distribution = a2 * w2 * w2 / np.pi
    nl, nv = light @ NORMAL, view @ NORMAL
    ggx_v = nl * np.sqrt((at * (t @ view)) ** 2 + (ab * (b @ view)) ** 2 + nv**2)
    ggx_l = nv * np.sqrt((at * (light @ t)) ** 2 + (ab * (light @ b)) ** 2 + nl**2)
    return np.asarray(distribution * 0.5 / (ggx_v + ggx_l))


@pytest.mark.parametrize("strength", [0.3, 0.7, 1.0])
@pytest.mark.parametrize("roughness", [0.2, 0.5])
@pytest.mark.parametrize("direction", [0.0, 0.9, -2.0])
def test_t65_highlights_are_those_of_the_extension(
    studio: Studio, strength: float, roughness: float, direction: float
) -> None:
    surface = {
        **METAL,
        "roughness": roughness,
        "anisotropy_strength": strength,
        "anisotropy_rotation": direction,
    }
    for view in (NORMAL, unit([0.5, 0.3, 0.6]), unit([-0.4, 0.8, 0.2])):
        for light in (unit([0.3, 0.2, 1.0]), unit([-0.6, -0.2, 0.5]), unit([0.1, -0.9, 0.3])):
            half_way = unit(view + light)
            base = np.array(METAL["base_color"])
            fresnel = base + (1 - base) * (1 - view @ half_way) ** 5
            expected = fresnel * lobe(view, light, roughness**2, strength, direction) * light[2]
            # The half vector is good to 2^-23, and the narrow width is alpha = 0.04.
            np.testing.assert_allclose(
                lit(studio, surface, view, light), expected, rtol=4e-5, atol=1e-8
            )


def test_without_strength_it_is_the_isotropic_surface_to_the_last_bit(studio: Studio) -> None:
    view, light = unit([0.5, 0.3, 0.6]), unit([-0.6, -0.2, 0.5])

    plain = lit(studio, {**METAL, "roughness": 0.4}, view, light)
    turned = {**METAL, "roughness": 0.4, "anisotropy_rotation": 1.0, "anisotropy_y": 3.0}

    np.testing.assert_array_equal(lit(studio, turned, view, light), plain)


def test_a_map_of_no_strength_is_the_isotropic_surface(studio: Studio) -> None:
    view, light = unit([0.5, 0.3, 0.6]), unit([-0.6, -0.2, 0.5])
    none = {"anisotropy_strength": {"texture": studio.texture([[0.0]])}}
    sky = {"texture": studio.texture(1 + latlong(64)[..., 0]), "visible": False}

    for lights in ({"environment": sky}, {"lights": [WHITE_SKY]}, {}):
        for more in ({}, {"energy_compensation": True}):
            surface = {**METAL, "roughness": 0.4, **more}
            lamp = {"type": "directional", "direction": list(-light)}
            scene: dict[str, Any] = {"lights": [lamp], **lights}
            np.testing.assert_allclose(
                seen(studio, {**surface, **none}, view, **scene),
                seen(studio, surface, view, **scene),
                rtol=1e-5,
            )


def test_the_direction_may_come_from_a_map(studio: Studio) -> None:
    # The extension's texture: red and green are x and y in 0..1, blue is the strength.
    view, light, angle = unit([0.5, 0.3, 0.6]), unit([-0.3, 0.2, 0.5]), 2.2
    texel = [0.5 + 0.3 * np.cos(angle), 0.5 + 0.3 * np.sin(angle), 0.75]
    texture = studio.texture([[texel]])
    mapped = {
        "anisotropy_strength": {"texture": texture, "channel": "b", "scale": 0.8},
        "anisotropy_x": {"texture": texture, "channel": "r", "scale": 2.0, "bias": -1.0},
        "anisotropy_y": {"texture": texture, "channel": "g", "scale": 2.0, "bias": -1.0},
        "anisotropy_rotation": 0.5,
    }

    shown = lit(studio, {**WHITE, "roughness": 0.4, **mapped}, view, light)

    expected = lobe(view, light, 0.16, 0.6, angle + 0.5) * light[2]
    np.testing.assert_allclose(shown, expected, rtol=2e-5)


@pytest.mark.parametrize(("strength", "counts_as"), [(-2.0, 0.0), (7.0, 1.0)])
def test_strengths_beyond_0_to_1_count_as_the_end(
    studio: Studio, strength: float, counts_as: float
) -> None:
    view, light = unit([0.5, 0.3, 0.6]), unit([-0.6, -0.2, 0.5])
    mapped = {"texture": studio.texture([[1.0]]), "scale": strength}

    np.testing.assert_allclose(
        lit(studio, {**METAL, "roughness": 0.4, "anisotropy_strength": mapped}, view, light),
        lit(studio, {**METAL, "roughness": 0.4, "anisotropy_strength": counts_as}, view, light),
        rtol=1e-5,
    )


@pytest.mark.parametrize("x", [0.0, 1e30, -1e-30])
def test_directions_of_no_and_of_any_length_are_finite(studio: Studio, x: float) -> None:
    view, light = unit([0.5, 0.3, 0.6]), unit([-0.6, -0.2, 0.5])
    surface = {**METAL, "roughness": 0.0, "anisotropy_strength": 0.5, "anisotropy_x": x}

    shown = lit(studio, surface, view, light)

    assert np.isfinite(shown).all()
    # No direction is that of u; one of another sign is the same axis.
    along = lit(studio, {**surface, "anisotropy_x": 1.0}, view, light)
    np.testing.assert_allclose(shown, along, rtol=1e-6)


@pytest.mark.parametrize("bad", [np.nan, np.inf, -np.inf, 3e38])
@pytest.mark.parametrize("name", ["strength", "rotation", "x", "y"])
def test_maps_of_what_is_no_number_stay_finite(studio: Studio, name: str, bad: float) -> None:
    mapped = {"texture": studio.texture([[bad]])}
    surface = {**METAL, "roughness": 0.4, "anisotropy_strength": 0.5}

    shown = lit(studio, {**surface, f"anisotropy_{name}": mapped}, NORMAL, unit([0.3, 0.2, 1.0]))

    assert np.isfinite(shown).all()
