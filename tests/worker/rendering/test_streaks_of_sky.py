"""What brushed things show of a sky (T65), against sums over all of its directions."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from tests.worker.rendering.studio import Studio
from tests.worker.rendering.surroundings import latlong
from tests.worker.rendering.test_anisotropic_highlights import (
    NORMAL,
    WHITE,
    WHITE_SKY,
    Floats,
    lobe,
    seen,
    unit,
)

pytestmark = pytest.mark.gl

BLACK = {"diffuse_color": [0.0, 0.0, 0.0]}
VIEWS = [NORMAL, unit([0.5, 0.2, 0.7]), unit([-0.2, 0.7, 0.5])]
ALL = latlong(512)
# A bright patch and a gradient
LIGHT = 0.4 + 2.0 * (ALL @ unit([0.4, 0.3, 0.8]) > 0.85) + 0.3 * ALL[..., 0]
# Only what is above the square shines on it. y is up: rows have equal latitudes.
ABOVE = ALL[..., 2] > 0
TOWARDS = ALL[ABOVE]
SOLID = np.sqrt(1 - TOWARDS[:, 1] ** 2) * (2 * np.pi**2 / 512 / 256)


def ward(view: Floats, light: Floats, along: float, across: float) -> Floats:
    """The glossy part for rs = 1, of many directions of light above the square."""
    h = view + light
    slope = ((h[..., 0] / along) ** 2 + (h[..., 1] / across) ** 2) / h[..., 2] ** 2
    root = np.sqrt(np.maximum(light[..., 2], 1e-9) * view[2])
    return np.asarray(np.exp(-slope) / (4 * np.pi * along * across * root))


def ashikhmin_shirley(view: Floats, light: Floats, nu: float, nv: float) -> Floats:
    """The glossy part for Rs = 1."""
    h = view + light
    h /= np.linalg.norm(h, axis=-1, keepdims=True)
    power = (nu * h[..., 0] ** 2 + nv * h[..., 1] ** 2) / np.maximum(1 - h[..., 2] ** 2, 1e-12)
    peak = np.sqrt((nu + 1) * (nv + 1)) / (8 * np.pi) * np.maximum(h[..., 2], 0) ** power
    return np.asarray(peak / ((h @ view) * np.maximum(light[..., 2], view[2])))


def streaked(strength: float) -> dict[str, Any]:
    return {**WHITE, "roughness": 0.35, "anisotropy_strength": strength}


BRUSHED: dict[str, tuple[dict[str, Any], Callable[[Floats, Floats], Floats]]] = {
    "round": (streaked(0.0), lambda v, light: lobe(v, light, 0.35**2, 0.0, 0.0)),
    "a little": (streaked(0.3), lambda v, light: lobe(v, light, 0.35**2, 0.3, 0.0)),
    "much": (streaked(0.7), lambda v, light: lobe(v, light, 0.35**2, 0.7, 0.0)),
    "ward": (
        {
            "technique": "ward",
            **BLACK,
            "specular_color": [1.0, 1.0, 1.0],
            "roughness_along": 0.1,
            "roughness_across": 0.4,
        },
        lambda v, light: ward(v, light, 0.1, 0.4),
    ),
    "ashikhmin_shirley": (
        {
            "technique": "ashikhmin_shirley",
            **BLACK,
            "specular_color": [1.0, 1.0, 1.0],
            "exponent_along": 20.0,
            "exponent_across": 300.0,
        },
        lambda v, light: ashikhmin_shirley(v, light, 20.0, 300.0),
    ),
}


@pytest.mark.parametrize("name", BRUSHED)
def test_t65_the_sky_is_seen_as_its_mean_over_the_lobe(studio: Studio, name: str) -> None:
    # A dozen round lobes in the place of a long one; those of Gaussian slopes have GGX's tails.
    surface, reflects = BRUSHED[name]
    tolerance = 0.07 if surface["technique"] == "metallic_roughness" else 0.21
    sky = {"texture": studio.texture(LIGHT), "visible": False}

    for view in VIEWS:
        weight = reflects(view, TOWARDS) * TOWARDS[:, 2] * SOLID
        expected = (weight * LIGHT[ABOVE]).sum() / weight.sum()
        shown = seen(studio, surface, view, environment=sky)
        white = seen(studio, surface, view, lights=[WHITE_SKY])
        assert shown[1] / white[1] == pytest.approx(expected, rel=tolerance)


def shares(view: Floats, roughness: float, strength: float) -> tuple[float, float]:
    """What white metal, and what F0 = 0 reflects of an even sky: sums over the sky's directions.

    They lie on rings round z that are narrower near the horizon and near z, and each facet of a
    narrow lobe is wider than a cell.
    """
    z, wz = np.polynomial.legendre.leggauss(128)
    z, wz = (z + 1) / 2, wz / 2
    turn = 2 * np.pi * (np.arange(512) + 0.5) / 512
    across = np.sqrt(1 - z**2)[:, None]
    towards = np.stack(
        [across * np.cos(turn), across * np.sin(turn), np.broadcast_to(z[:, None], (128, 512))],
        axis=-1,
    )
    weight = lobe(view, towards, roughness**2, strength, 0.0) * z[:, None]
    weight *= wz[:, None] * 2 * np.pi / 512
    grazing = (1 - unit_rows(view + towards) @ view) ** 5
    return float(weight.sum()), float((weight * grazing).sum())


def unit_rows(vectors: Floats) -> Floats:
    return np.asarray(vectors / np.linalg.norm(vectors, axis=-1, keepdims=True))


GRAZING = [unit([np.cos(p), np.sin(p), 0.25]) for p in (0.0, 0.8, np.pi / 2)]


def test_t65_streaked_metal_reflects_the_share_of_an_even_sky_that_its_lobe_does(
    studio: Studio,
) -> None:
    errors, white_errors = [], []
    for roughness in (0.35, 0.5, 0.7):
        for strength in (0.3, 0.6, 0.9, 1.0):
            surface = {**WHITE, "roughness": roughness, "anisotropy_strength": strength}
            black = {**surface, "base_color": [0.0, 0.0, 0.0]}
            for view in (*VIEWS, *GRAZING):
                every, grazing = shares(view, roughness, strength)
                shown = seen(studio, surface, view, lights=[WHITE_SKY])[1]
                white_errors.append(shown - every)
                errors.append(seen(studio, black, view, lights=[WHITE_SKY])[1] - grazing)

    # Two dozen facets; a round lobe of the mean squared width was .045 off (RMS), .34 at most.
    assert np.sqrt(np.mean(np.square(white_errors))) < 0.012
    assert np.abs(white_errors).max() < 0.03
    assert np.sqrt(np.mean(np.square(errors))) < 0.003
    assert np.abs(errors).max() < 0.008


def test_t65_in_a_furnace_streaked_white_metal_that_keeps_its_energy_is_white(
    studio: Studio,
) -> None:
    for roughness in (0.2, 0.7):
        for strength in (0.3, 1.0):
            surface = {**WHITE, "roughness": roughness, "anisotropy_strength": strength}
            surface |= {"energy_compensation": True}
            for view in (*VIEWS, *GRAZING):
                shown = seen(studio, surface, view, lights=[WHITE_SKY])
                np.testing.assert_allclose(shown, 1.0, rtol=1e-5)
