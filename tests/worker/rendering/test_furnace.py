"""metallic_roughness under a uniform sky: what comes back of light from everywhere (X17)."""

import numpy as np
import pytest

from tests.worker.rendering.studio import Studio
from tests.worker.rendering.test_metallic_roughness import MIRROR, WHITE_SKY, X17, slanted

pytestmark = pytest.mark.gl


def test_the_furnace_keeps_white_chalk_white(studio: Studio) -> None:
    chalk = {"technique": "metallic_roughness", "metallic": 0.0, "specular": 0.0}

    for cosine in (1.0, 0.5, 0.1):
        np.testing.assert_allclose(slanted(studio, chalk, cosine, [WHITE_SKY]), 1, atol=1e-3)


@pytest.mark.parametrize(("roughness", "cosine", "a", "b"), X17)
def test_the_furnace_shows_a_white_metals_single_bounce(
    studio: Studio, roughness: float, cosine: float, a: float, b: float
) -> None:
    seen = slanted(studio, {**MIRROR, "roughness": roughness}, cosine, [WHITE_SKY])

    np.testing.assert_allclose(seen, a + b, atol=2e-3)


@pytest.mark.parametrize(("roughness", "cosine", "a", "b"), X17)
def test_the_furnace_shows_f0_a_plus_b(
    studio: Studio, roughness: float, cosine: float, a: float, b: float
) -> None:
    colour = np.array([0.9, 0.5, 0.1])
    surface = {**MIRROR, "roughness": roughness, "base_color": list(colour)}

    seen = slanted(studio, surface, cosine, [WHITE_SKY])

    np.testing.assert_allclose(seen, colour * a + b, atol=2e-3)


@pytest.mark.parametrize("roughness", [0.0, 0.3, 0.5, 0.8, 1.0])
@pytest.mark.parametrize("cosine", [1.0, 0.8, 0.5, 0.1, 0.03])
def test_with_energy_compensation_nothing_is_lost(
    studio: Studio, roughness: float, cosine: float
) -> None:
    surface = {**MIRROR, "roughness": roughness, "energy_compensation": True}

    seen = slanted(studio, surface, cosine, [WHITE_SKY])

    np.testing.assert_allclose(seen, 1, atol=5e-3)


@pytest.mark.parametrize(("roughness", "cosine", "a", "b"), X17)
@pytest.mark.parametrize("metallic", [0.0, 1.0])
def test_energy_compensation_is_turquins(
    studio: Studio, metallic: float, roughness: float, cosine: float, a: float, b: float
) -> None:
    # Black glass with F0 = ((5 - 1) / (5 + 1))^2, or a metal of it
    f0 = 4 / 9
    surface = {
        "technique": "metallic_roughness",
        "base_color": [metallic * f0] * 3,
        "metallic": metallic,
        "ior": 5.0,
        "roughness": roughness,
        "energy_compensation": True,
    }

    seen = slanted(studio, surface, cosine, [WHITE_SKY])

    expected = (f0 * a + b) * (1 + f0 * (1 - a - b) / (a + b))
    np.testing.assert_allclose(seen, expected, atol=2e-3)


@pytest.mark.parametrize("cosine", [0.9, 0.5, 0.3, 0.1])
def test_a_mirror_shows_fresnels_term_itself(studio: Studio, cosine: float) -> None:
    surface = {**MIRROR, "base_color": [0.0, 0.5, 1.0], "roughness": 0.0}

    seen = slanted(studio, surface, cosine, [WHITE_SKY])

    # Between the table's columns, 1/63 apart, (1 - x)^5 bends by 20 / 8 / 63^2 at most.
    expected = np.array([0, 0.5, 1]) + np.array([1, 0.5, 0]) * (1 - cosine) ** 5
    np.testing.assert_allclose(seen, expected, atol=7e-4)


@pytest.mark.parametrize("compensation", [False, True])
@pytest.mark.parametrize("varnish", [0.0, 1.0])
def test_nothing_shows_more_than_the_furnace_has(
    studio: Studio, compensation: bool, varnish: float
) -> None:
    for metallic in (0.0, 0.5, 1.0):
        for cosine in (1.0, 0.4, 0.05):
            seen = slanted(
                studio,
                {
                    "technique": "metallic_roughness",
                    "metallic": metallic,
                    "roughness": 0.6,
                    "ior": 1.8,
                    "clearcoat": varnish,
                    "energy_compensation": compensation,
                },
                cosine,
                [WHITE_SKY],
            )
            assert (seen <= 1 + 1e-3).all()
            assert (seen >= (1 - 1e-3 if compensation and not varnish else 0.7)).all()


def test_a_white_plastic_keeps_the_furnaces_light(studio: Studio) -> None:
    plastic = {"technique": "metallic_roughness", "metallic": 0.0, "roughness": 0.4}

    for cosine in (1.0, 0.5, 0.1):
        np.testing.assert_allclose(slanted(studio, plastic, cosine, [WHITE_SKY]), 1, atol=1e-5)


@pytest.mark.parametrize("roughness", [0.5, 1.0])
def test_punctual_light_from_all_sides_adds_up_to_the_furnace(
    studio: Studio, roughness: float
) -> None:
    # The sky of radiance 1 as so many lamps of irradiance dw: Gauss in cos^2, steps half round
    cosine, rings, steps = 0.5, 40, 32
    points, weights = np.polynomial.legendre.leggauss(rings)
    for compensation in (False, True):
        surface = {**MIRROR, "roughness": roughness, "energy_compensation": compensation}
        total = np.zeros(3)
        for ring in range(rings):
            nl = np.sqrt((points[ring] + 1) / 2)
            angle = np.pi * (np.arange(steps) + 0.5) / steps
            # f n.l is what is drawn for irradiance 1, and n.l dw = dx dphi / 2 with x = (n.l)^2
            irradiance = weights[ring] / 2 * np.pi / steps / nl
            across = np.sqrt(1 - nl**2)
            lamps = [
                {
                    "type": "directional",
                    "direction": [-across * np.cos(a), -across * np.sin(a), -nl],
                    "irradiance": irradiance,
                }
                for a in angle
            ]
            total += slanted(studio, surface, cosine, lamps)
        sky = slanted(studio, surface, cosine, [WHITE_SKY])
        np.testing.assert_allclose(total, sky, atol=5e-3)
