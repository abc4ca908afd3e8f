"""The table of split sums against published values and limits that are known in closed form."""

import math

import numpy as np
import pytest

from api_schemas.textures.dfg import DfgSpec
from worker.stages import silent
from worker.synthesis import synthesize
from worker.synthesis.dfg import reflectance


def table(size, **spec):
    return synthesize(DfgSpec(technique="dfg", **spec), size, {}, silent).pixels.astype(np.float64)


@pytest.mark.parametrize(
    ("roughness", "cosine", "a", "b"),
    # X17 of the reference, from 65536 samples
    [(0.5, 0.5, 0.83492, 0.02235), (0.3, 0.8, 0.98688, 0.00080), (1.0, 1.0, 0.30682, 0.00003)],
)
def test_published_values(roughness, cosine, a, b):
    np.testing.assert_allclose(reflectance(roughness, cosine), (a, b), atol=1e-4)


def test_seen_head_on_the_roughest_mirror_gives_back_1_minus_ln_2():
    assert sum(reflectance(1.0, 1.0)) == pytest.approx(1 - math.log(2), abs=1e-6)


@pytest.mark.parametrize("cosine", [0.05, 0.3, 0.7, 1.0])
def test_a_mirror_is_fresnels_term_itself(cosine):
    rest = (1 - cosine) ** 5

    np.testing.assert_allclose(reflectance(0.0, cosine), (1 - rest, rest), atol=1e-4)


@pytest.mark.parametrize(("roughness", "cosine"), [(0.5, 0.5), (0.9, 0.2), (0.25, 0.9)])
def test_it_is_the_integral_of_the_reflection_over_all_lights(roughness, cosine):
    # The other way round: over directions of light, D and V as glTF 2.0, appendix B, has them
    alpha = roughness**2
    points, weights = np.polynomial.legendre.leggauss(1200)
    z, angle = (points + 1) / 2, np.pi * (np.arange(1200) + 0.5) / 1200
    across = np.sqrt(1 - z**2)
    light = np.stack(
        [np.outer(across, np.cos(angle)), np.outer(across, np.sin(angle)), z[:, None] + 0 * angle]
    )
    view = np.array([math.sqrt(1 - cosine**2), 0.0, cosine])
    half = light + view[:, None, None]
    half /= np.linalg.norm(half, axis=0)
    view_half = np.tensordot(view, half, 1)
    d = alpha**2 / (np.pi * (half[2] ** 2 * (alpha**2 - 1) + 1) ** 2)
    smith = light[2] * np.sqrt(cosine**2 * (1 - alpha**2) + alpha**2)
    smith = smith + cosine * np.sqrt(light[2] ** 2 * (1 - alpha**2) + alpha**2)
    reflected = d * 0.5 / smith * light[2] * (weights / 2 * 2 * np.pi / 1200)[:, None]
    fresnel = (1 - view_half) ** 5

    expected = ((reflected * (1 - fresnel)).sum(), (reflected * fresnel).sum())
    np.testing.assert_allclose(reflectance(roughness, cosine), expected, atol=2e-5)


def test_u_is_the_cosine_and_v_upwards_the_roughness():
    pixels = table((8, 4))

    for row, column in ((0, 0), (3, 0), (1, 5)):
        a, b = reflectance(1 - (row + 0.5) / 4, (column + 0.5) / 8)
        np.testing.assert_allclose(pixels[row, column], (a, b, a + b), rtol=1e-6)


def test_the_outermost_pixels_may_show_the_ends():
    pixels = table((5, 3), span="edges")

    np.testing.assert_allclose(pixels[0, 4, :2], reflectance(1.0, 1.0), rtol=1e-6)
    np.testing.assert_allclose(pixels[2, 4, :2], reflectance(0.0, 1.0), atol=1e-6)
    np.testing.assert_allclose(pixels[1, 2, :2], reflectance(0.5, 0.5), rtol=1e-6)


@pytest.mark.parametrize("span", ["centres", "edges"])
def test_a_single_pixel_is_the_middle(span):
    np.testing.assert_allclose(table((1, 1), span=span)[0, 0, :2], reflectance(0.5, 0.5), rtol=1e-6)


def test_nothing_reflects_more_than_there_is_and_rougher_reflects_less():
    pixels = table((33, 33), span="edges")

    assert pixels.min() >= 0
    assert pixels[..., 2].max() <= 1 + 2e-5
    assert (np.diff(pixels[:, 8:, 2], axis=0) >= -2e-5).all()
