"""metallic_roughness against the published formulas, written out in float64 (X17)."""

from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from tests.worker.rendering.studio import Pixels, Studio
from tests.worker.rendering.test_vertex_arrays import points_that_face
from worker.geometry.sphere import sphere

pytestmark = pytest.mark.gl

Floats = NDArray[np.float64]
WHITE_SKY = {"type": "ambient", "radiance": [1.0, 1.0, 1.0]}
MIRROR = {"technique": "metallic_roughness", "metallic": 1.0, "base_color": [1.0, 1.0, 1.0]}
# roughness, n.v, A, B
X17 = [(0.5, 0.5, 0.83492, 0.02235), (0.3, 0.8, 0.98688, 0.0008), (1.0, 1.0, 0.30682, 0.00003)]


def polished_things(studio: Studio) -> dict[str, Any]:
    """A varnished, dented ball, and points and lines of its vertices round it."""
    ball = sphere(1.0, 24, 12)
    dents = np.random.default_rng(8).normal([0, 0, 3], 1, (16, 16, 3))
    surface = {
        "technique": "metallic_roughness",
        "base_color": [0.9, 0.5, 0.2],
        "roughness": 0.4,
        "clearcoat": 0.5,
        "energy_compensation": True,
        "normal": {"texture": studio.texture(dents), "range": "signed"},
    }
    edges = ball.triangles[:, :2].copy()
    wires = replace(ball, positions=1.2 * ball.positions, triangles=edges, kind="lines")
    pins = replace(ball, positions=1.4 * ball.positions, triangles=edges[:, :1], kind="points")
    return {
        "camera": {"type": "perspective", "pose": {"eye": [1.0, 2.0, 3.0]}},
        "lights": [WHITE_SKY, {"type": "directional", "direction": [-0.4, -1.0, -0.3]}],
        "nodes": [
            {"mesh": {"type": "sphere"}, "surface": surface},
            {"mesh": studio.mesh(wires), "surface": {"technique": "metallic_roughness"}},
            {"mesh": studio.mesh(pins), "surface": {"technique": "unlit"}},
        ],
    }


def slanted(studio: Studio, surface: dict[str, Any], cosine: float, lights: Any) -> Floats:
    """See a square at a slant: every pixel has the same n.v. The colour of one of them."""
    sine = float(np.sqrt(1 - cosine**2))
    drawn = studio.draw(
        {
            "camera": {
                "type": "orthographic",
                "height": 0.1,
                "pose": {"eye": [3 * sine, 0.0, 3 * cosine]},
            },
            "lights": lights,
            "nodes": [{"mesh": {"type": "plane"}, "surface": surface}],
        },
        (2, 2),
    )
    return drawn[0, 0, :3].astype(np.float64)


def unit(vector: Any) -> Floats:
    return np.asarray(vector, dtype=np.float64) / np.linalg.norm(vector)


def specular_brdf(n: Floats, v: Floats, light: Floats, alpha: float) -> float:
    """D V of glTF 2.0, appendix B.3.2, as written there."""
    h = unit(v + light)
    nh, nl, nv = n @ h, n @ light, n @ v
    distribution = alpha**2 / (np.pi * (nh**2 * (alpha**2 - 1) + 1) ** 2)
    one = 2 * nl / (nl + np.sqrt(alpha**2 + (1 - alpha**2) * nl**2))
    other = 2 * nv / (nv + np.sqrt(alpha**2 + (1 - alpha**2) * nv**2))
    # Height-correlated Smith (Heitz 2014); appendix B's V is 0.5 over this denominator
    together = nl * np.sqrt(nv**2 * (1 - alpha**2) + alpha**2)
    together += nv * np.sqrt(nl**2 * (1 - alpha**2) + alpha**2)
    assert one * other <= 4 * nl * nv * 0.5 / together + 1e-12  # correlated shadows overlap
    return float(distribution * 0.5 / together)


def expected_radiance(surface: dict[str, Any], n: Floats, v: Floats, light: Floats) -> Floats:
    """f n.l for irradiance 1, from the text of glTF 2.0 and its three extensions."""
    base = np.array(surface.get("base_color", [1.0, 1.0, 1.0]))
    metallic, roughness = surface.get("metallic", 1.0), surface.get("roughness", 1.0)
    ior, weight = surface.get("ior", 1.5), surface.get("specular", 1.0)
    tint = np.array(surface.get("specular_color", [1.0, 1.0, 1.0]))
    nl = n @ light
    if nl <= 0:
        return np.zeros(3)
    h = unit(v + light)
    rise = (1 - abs(v @ h)) ** 5
    specular = specular_brdf(n, v, light, roughness**2)
    metal = specular * (base + (1 - base) * rise)
    f0 = np.minimum(((1 - ior) / (1 + ior)) ** 2 * tint, 1)
    fresnel = f0 + (1 - f0) * rise
    dielectric = (1 - weight * fresnel.max()) * base / np.pi + weight * fresnel * specular
    below = (1 - metallic) * dielectric + metallic * metal
    coat = surface.get("clearcoat", 0.0) * (0.04 + 0.96 * (1 - abs(n @ v)) ** 5)
    if coat:
        varnish = specular_brdf(n, v, light, surface.get("clearcoat_roughness", 0.0) ** 2)
        below = (1 - coat) * below + coat * varnish
    return np.asarray(below * nl)


SURFACES: dict[str, dict[str, Any]] = {
    "metal": {"base_color": [0.9, 0.6, 0.2]},
    "dielectric": {"base_color": [0.2, 0.5, 0.8], "metallic": 0.0},
    "half": {"base_color": [0.2, 0.5, 0.8], "metallic": 0.5},
    "diamond": {"metallic": 0.0, "ior": 2.4, "specular_color": [1.0, 0.5, 8.0]},
    "dull": {"metallic": 0.0, "specular": 0.25, "specular_color": [1.0, 0.2, 0.4]},
    "varnished": {"base_color": [0.9, 0.6, 0.2], "clearcoat": 0.8, "clearcoat_roughness": 0.3},
}


@pytest.mark.parametrize("roughness", [0.15, 0.4, 1.0])
@pytest.mark.parametrize("cosine", [1.0, 0.7, 0.15])
@pytest.mark.parametrize("name", SURFACES)
def test_light_comes_back_as_the_formulas_say(
    studio: Studio, name: str, cosine: float, roughness: float
) -> None:
    surface = {**SURFACES[name], "roughness": roughness}
    view = np.array([np.sqrt(1 - cosine**2), 0.0, cosine])

    for towards in ([0.3, 0.2, 1.0], [-view[0], 0.0, cosine], [0.9, -0.5, 0.2], [0.1, 0.2, -1.0]):
        light = unit(towards)
        lamp = {"type": "directional", "direction": list(-light)}
        seen = slanted(studio, {"technique": "metallic_roughness", **surface}, cosine, [lamp])

        expected = expected_radiance(surface, np.array([0.0, 0.0, 1.0]), view, light)
        # The half vector is good to 2^-23, and the peak's width is alpha = 0.0225.
        np.testing.assert_allclose(seen, expected, rtol=4e-5, atol=1e-7)


def test_highlights_on_a_ball(studio: Studio) -> None:
    # A sharp highlight all over its slope, with a normal of its own at every pixel
    side = 64
    surface = {"base_color": [0.9, 0.6, 0.2], "metallic": 0.6, "roughness": 0.35}
    light = unit([0.4, 0.5, 1.0])

    drawn = studio.draw(
        {
            "camera": {"type": "orthographic", "height": 1.2, "pose": {"eye": [0.0, 0.0, 5.0]}},
            "lights": [{"type": "directional", "direction": list(-light)}],
            "nodes": [
                {
                    "mesh": {"type": "sphere", "segments": 512, "rings": 256},
                    "surface": {"technique": "metallic_roughness", **surface},
                }
            ],
        },
        (side, side),
    )

    place = ((np.arange(side) + 0.5) / side * 2 - 1) * 0.6
    x, y = np.meshgrid(place, place[::-1])
    normal = np.stack([x, y, np.sqrt(1 - x**2 - y**2)], axis=2).reshape(-1, 3)
    view = np.array([0.0, 0.0, 1.0])
    expected = np.array([expected_radiance(surface, n, view, light) for n in normal])
    # Facets of 2 pi / 512 shift the normal by up to 5e-5; the slope of the peak is some 1 / alpha,
    # and where the light only grazes the ball, that shift is as large as n.l.
    np.testing.assert_allclose(drawn[..., :3].reshape(-1, 3), expected, rtol=2e-3, atol=1e-5)


@pytest.mark.parametrize("roughness", [0.0, 0.01])
def test_the_smoothest_highlight_is_finite_and_where_it_should_be(
    studio: Studio, roughness: float
) -> None:
    lamp = {"type": "directional", "direction": [0.0, 0.0, -1.0]}

    straight = slanted(studio, {**MIRROR, "roughness": roughness}, 1.0, [lamp])
    beside = slanted(studio, {**MIRROR, "roughness": roughness}, 0.99, [lamp])

    # D V n.l = 1 / (pi alpha^2) / 4 with alpha = 1e-4 at the least
    np.testing.assert_allclose(straight, 1e8 / (4 * np.pi), rtol=1e-5)
    assert (beside < 1e-3).all()


def test_occlusion_dims_the_sky_and_nothing_else(studio: Studio) -> None:
    lamp = {"type": "directional", "direction": [-0.3, 0.0, -1.0]}
    surface = {"technique": "metallic_roughness", "metallic": 0.3, "emission": [0.5, 0.0, 0.0]}

    def lit(occlusion: float, lights: Any) -> Floats:
        return slanted(studio, {**surface, "occlusion": occlusion}, 0.6, lights)

    np.testing.assert_array_equal(lit(0.25, [lamp]), lit(1.0, [lamp]))
    glow = np.array([0.5, 0.0, 0.0])
    np.testing.assert_allclose(
        lit(0.25, [WHITE_SKY]) - glow, 0.25 * (lit(1.0, [WHITE_SKY]) - glow), atol=1e-6
    )


def test_emission_shines_through_the_varnish_less_what_that_reflects(studio: Studio) -> None:
    # KHR_materials_clearcoat: head-on the varnish reflects 0.04
    surface = {"technique": "metallic_roughness", "emission": [4.0, 2.0, 0.0], "clearcoat": 1.0}

    np.testing.assert_allclose(slanted(studio, surface, 1.0, []), [3.84, 1.92, 0], rtol=1e-6)


def test_the_varnish_lies_smooth_over_a_normal_map(studio: Studio) -> None:
    tilted = {"texture": studio.texture([[[0.6, 0.0, 0.8]]]), "range": "signed"}
    lamp = {"type": "directional", "direction": [0.0, 0.0, -1.0]}
    black = {
        "technique": "metallic_roughness",
        "base_color": [0.0, 0.0, 0.0],
        "specular": 0.0,
        "metallic": 0.0,
        "clearcoat": 1.0,
        "clearcoat_roughness": 0.5,
    }

    plain = slanted(studio, black, 1.0, [lamp])
    mapped = slanted(studio, {**black, "normal": tilted}, 1.0, [lamp])

    np.testing.assert_allclose(mapped, plain, rtol=1e-6)
    # 0.04 / (4 pi alpha^2)
    np.testing.assert_allclose(plain, 0.04 / (4 * np.pi * 0.0625), rtol=1e-5)


def test_a_meshs_colour_multiplies_the_base_colour(studio: Studio) -> None:
    surface = {"technique": "metallic_roughness", "emission": [0.25, 0.0, 0.0]}
    camera = {"type": "orthographic", "height": 2.0, "pose": {"eye": [0.0, 0.0, 2.0]}}

    def points(normal: list[float]) -> Pixels:
        node = {"mesh": studio.mesh(points_that_face(normal)), "surface": surface}
        return studio.draw({"camera": camera, "lights": [WHITE_SKY], "nodes": [node]}, (16, 16))

    # A metal of that colour, seen head-on: F0 A + B; without normals the colour itself
    colour = np.array([1.0, 0.5, 0.25])
    a, b = X17[2][2:]
    glow = np.array([0.25, 0, 0])
    np.testing.assert_allclose(points([0, 0, 1])[3, 3, :3], glow + colour * a + b, atol=1e-4)
    np.testing.assert_array_equal(points([0, 0, 0])[3, 3, :3], glow + colour)


@pytest.mark.parametrize("name", ["metallic", "roughness", "specular", "clearcoat"])
@pytest.mark.parametrize("value", [-3.0, 7.0])
def test_what_a_map_reads_beyond_0_to_1_counts_as_the_end(
    studio: Studio, name: str, value: float
) -> None:
    lights = [WHITE_SKY, {"type": "directional", "direction": [-0.3, 0.1, -1.0]}]
    surface = {"technique": "metallic_roughness", "metallic": 0.2, "roughness": 0.4}
    mapped = {"texture": studio.texture([[1.0]]), "scale": value}

    np.testing.assert_allclose(
        slanted(studio, {**surface, name: mapped}, 0.7, lights),
        slanted(studio, {**surface, name: min(max(value, 0.0), 1.0)}, 0.7, lights),
        rtol=1e-6,
    )
