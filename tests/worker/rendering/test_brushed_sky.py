"""Brushed surfaces in an environment and under an even sky (T65)."""

from typing import Any

import numpy as np
import pytest

from tests.worker.rendering.studio import Studio
from tests.worker.rendering.surroundings import ball, coded, latlong
from tests.worker.rendering.test_anisotropic_highlights import WHITE_SKY, seen, unit

pytestmark = [pytest.mark.gl, pytest.mark.usefixtures("small_cubes")]

EVEN = np.full((32, 64, 3), [0.25, 0.5, 2.0], np.float32)
VIEW = unit([0.5, 0.3, 0.6])


def test_brushed_metal_without_scratches_is_phong_in_an_environment(studio: Studio) -> None:
    sky = {"texture": studio.texture(coded(latlong(128)))}
    parts = {"diffuse_color": [0.2, 0.3, 0.4], "specular_color": [0.9, 0.8, 0.7], "exponent": 50.0}

    smooth = {"technique": "brushed_metal", "along": 1.0, "across": 1.0, **parts}
    brushed = ball(studio, sky, smooth, 32)
    phong = ball(studio, sky, {"technique": "phong", "specular_weight": 1.0, **parts}, 32)

    # At the rim the mirrored directions of two formulas turn 2^-23 / n.v apart.
    np.testing.assert_allclose(brushed, phong, atol=2e-5)


@pytest.mark.parametrize(("along", "across"), [(0.2, 1.0), (0.0, 0.5), (1.0, 1.0)])
def test_t65_an_even_sky_in_brushed_metal_is_m_v_to_the_n(
    studio: Studio, along: float, across: float
) -> None:
    # (r^T M v)^n = |M v|^n (r.w)^n with w along M v: its mean over r is |M v|^n times Phong's
    surface = {
        "technique": "brushed_metal",
        "diffuse_color": [0.0, 0.0, 0.0],
        "specular_color": [0.8, 0.4, 0.2],
        "exponent": 6.0,
        "along": along,
        "across": across,
    }

    shown = seen(studio, surface, VIEW, environment={"texture": studio.texture(EVEN)})

    size = np.linalg.norm(VIEW * [along, across, 1.0])
    np.testing.assert_allclose(shown, np.array([0.8, 0.4, 0.2]) * EVEN[0, 0] * size**6, rtol=1e-3)


def test_t65_brushed_metal_mirrors_the_view_that_m_turns(studio: Studio) -> None:
    # With |M v|^n made up for; what a lobe shows of coded directions is grey and its axis.
    mapped = VIEW * [0.3, 1.0, 1.0]
    size = np.linalg.norm(mapped)
    sky = {"texture": studio.texture(coded(latlong(256))), "visible": False}
    surface = {
        "technique": "brushed_metal",
        "diffuse_color": [0.0, 0.0, 0.0],
        "specular_color": [float(size**-10)] * 3,
        "exponent": 10.0,
        "along": 0.3,
        "across": 1.0,
    }

    shown = seen(studio, surface, VIEW, environment=sky)
    found = unit(2 * shown - 1)

    expected = mapped / size * [-1, -1, 1]
    assert found @ expected > np.cos(0.1)


@pytest.mark.parametrize("technique", ["ward", "ashikhmin_shirley", "brushed_metal"])
def test_an_even_environment_is_the_ambient_light_of_its_radiance(
    studio: Studio, technique: str
) -> None:
    surface: dict[str, Any] = {"technique": technique, "diffuse_color": [0.2, 0.3, 0.4]}
    if technique == "brushed_metal":  # as in Phong's model, ambient light makes no highlight
        surface["specular_color"] = [0.0, 0.0, 0.0]
    environment = {"texture": studio.texture(np.ones((32, 64, 3))), "visible": False}

    shown = seen(studio, surface, VIEW, environment=environment)

    np.testing.assert_allclose(shown, seen(studio, surface, VIEW, lights=[WHITE_SKY]), rtol=1e-3)


def test_the_furnace_of_ward_is_both_colours(studio: Studio) -> None:
    surface = {
        "technique": "ward",
        "diffuse_color": [0.5, 0.25, 0.125],
        "specular_color": [0.5, 0.75, 0.875],
    }

    for view in (unit([0.0, 0.0, 1.0]), VIEW, unit([0.9, 0.1, 0.1])):
        np.testing.assert_allclose(seen(studio, surface, view, lights=[WHITE_SKY]), 1, rtol=1e-5)


@pytest.mark.parametrize("cosine", [1.0, 0.6, 0.2])
def test_the_furnace_of_ashikhmin_and_shirley_is_the_integral_of_their_matt_part(
    studio: Studio, cosine: float
) -> None:
    # 28 / (23 pi) (1 - (1 - c / 2)^5) n.l over the hemisphere is 1: Gauss and Legendre in n.l
    view = np.array([np.sqrt(1 - cosine**2), 0.0, cosine])
    colors = {"diffuse_color": [0.5, 0.25, 1.0], "specular_color": [0.1, 0.3, 0.0]}
    points, weights = np.polynomial.legendre.leggauss(8)
    facing = (points + 1) / 2
    part = np.sum(weights / 2 * 2 * np.pi * facing * (1 - (1 - facing / 2) ** 5))
    matt, gloss = np.array(colors["diffuse_color"]), np.array(colors["specular_color"])
    expected = 28 / (23 * np.pi) * matt * (1 - gloss) * (1 - (1 - cosine / 2) ** 5) * part
    expected += gloss + (1 - gloss) * (1 - cosine) ** 5  # of a mirror: a tight lobe is one

    surface = {"technique": "ashikhmin_shirley", **colors}
    shown = seen(studio, surface, view, lights=[WHITE_SKY])

    np.testing.assert_allclose(shown, expected, rtol=1e-5)
    assert (shown <= 1).all()
