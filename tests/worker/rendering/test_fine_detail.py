"""Relief finer than a pixel as roughness (X21), against Toksvig's formula and many samples."""

from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from tests.worker.rendering.studio import Studio
from tests.worker.rendering.test_anisotropic_highlights import NORMAL, lobe, unit

pytestmark = pytest.mark.gl

FRONT = {"type": "directional", "direction": [0.0, 0.0, -1.0]}
TILT = 0.3  # radians to the left and to the right
SHORTENED = np.cos(TILT)  # length of the mean of both normals
VARIANCE = (1 - SHORTENED) / SHORTENED  # of slopes, along each axis (Toksvig 2005)
BLACK: dict[str, Any] = {"diffuse_color": [0.0, 0.0, 0.0], "specular_color": [1.0, 1.0, 1.0]}


def ridged(studio: Studio, **how: Any) -> dict[str, Any]:
    """A map of two normals, so far away that each pixel sees their mean."""
    left, right = [-np.sin(TILT), 0.0, SHORTENED], [np.sin(TILT), 0.0, SHORTENED]
    return {
        "normal": {
            "texture": studio.texture([[left, right], [right, left]]),
            "range": "signed",
            "filter": "trilinear",
            "transform": {"scale": [64.0, 64.0]},
            "fine_detail": "roughness",
            **how,
        }
    }


def head_on(studio: Studio, surface: dict[str, Any]) -> float:
    return float(studio.poster(surface, (4, 4), lights=[FRONT])[1, 1, 1])


@pytest.mark.parametrize("exponent", [5.0, 100.0, 2000.0])
def test_x21_an_exponent_of_the_half_vector_is_toksvigs(studio: Studio, exponent: float) -> None:
    surface = {"technique": "ashikhmin_shirley", **BLACK}
    surface |= {"exponent_along": exponent, "exponent_across": exponent}

    shown = head_on(studio, {**surface, **ridged(studio)})

    # Toksvig's factor, and the model's height head-on (n + 1) / (8 pi)
    factor = SHORTENED / (SHORTENED + exponent * (1 - SHORTENED))
    assert shown == pytest.approx((factor * exponent + 1) / (8 * np.pi), rel=1e-4)


@pytest.mark.parametrize("technique", ["phong", "brushed_metal"])
def test_x21_an_exponent_of_the_mirrored_light_is_a_quarter_of_that(
    studio: Studio, technique: str
) -> None:
    # (r.v)^n is about (n.h)^4n; its integral, 2 pi / (n + 1), stays.
    surface = {"technique": technique, **BLACK, "exponent": 80.0}
    surface |= {"specular_weight": 1.0} if technique == "phong" else {"along": 1.0}

    shown = head_on(studio, {**surface, **ridged(studio)})

    factor = SHORTENED / (SHORTENED + 320 * (1 - SHORTENED))
    assert shown == pytest.approx((factor * 80 + 1) / 81, rel=1e-4)


def test_x21_with_normalisation_the_height_follows_by_itself(studio: Studio) -> None:
    surface = {"technique": "phong", **BLACK, "exponent": 80.0, "specular_weight": 1.0}
    surface |= {"normalization": "energy"}

    shown = head_on(studio, {**surface, **ridged(studio)})

    factor = SHORTENED / (SHORTENED + 320 * (1 - SHORTENED))
    assert shown == pytest.approx((factor * 80 + 2) / (2 * np.pi), rel=1e-4)


def test_x21_widths_grow_by_twice_the_variance(studio: Studio) -> None:
    ward = {"technique": "ward", **BLACK, "roughness_along": 0.1, "roughness_across": 0.3}
    glass = {"technique": "glass", "ior": 1.5, "roughness": 0.3}
    metal = {"technique": "metallic_roughness", "roughness": 0.3}

    wide = np.sqrt(np.square([0.1, 0.3, 0.09]) + 2 * VARIANCE)
    shown = head_on(studio, {**ward, **ridged(studio)})
    assert shown == pytest.approx(1 / (4 * np.pi * wide[0] * wide[1]), rel=1e-4)
    shown = head_on(studio, {**metal, **ridged(studio)})
    assert shown == pytest.approx(1 / (4 * np.pi * wide[2] ** 2), rel=1e-4)
    shown = head_on(studio, {**glass, **ridged(studio)})
    assert shown == pytest.approx(0.04 / (4 * np.pi * wide[2] ** 2), rel=1e-4)


def test_x21_both_widths_of_anisotropic_metal_grow(studio: Studio) -> None:
    metal = {"technique": "metallic_roughness", "roughness": 0.3, "anisotropy_strength": 0.4}

    shown = head_on(studio, {**metal, **ridged(studio)})

    wide = np.sqrt(np.square([0.09 + 0.91 * 0.16, 0.09]) + 2 * VARIANCE)
    assert shown == pytest.approx(1 / (4 * np.pi * wide[0] * wide[1]), rel=1e-4)


def test_x21_steeper_bumps_vary_more(studio: Studio) -> None:
    ward = {"technique": "ward", **BLACK, "roughness_along": 0.1, "roughness_across": 0.1}

    for strength in (0.0, 0.5, -2.0):
        shown = head_on(studio, {**ward, **ridged(studio, strength=strength)})
        wide = 0.01 + 2 * VARIANCE * strength**2
        assert shown == pytest.approx(1 / (4 * np.pi * wide), rel=1e-4)


@pytest.mark.parametrize("steepness", [1.0, -0.5])
def test_x21_bumps_tell_their_slopes_themselves(studio: Studio, steepness: float) -> None:
    # Slopes of +-.4 along u and of .1 along v: a mean of (0, .1), a variance of .16 and 0.
    tilts = [[[0.4, 0.1], [-0.4, 0.1]], [[-0.4, 0.1], [0.4, 0.1]]]
    bump = {
        "texture": studio.texture(tilts),
        "encoding": "float",
        "range": steepness,
        "filter": "trilinear",
        "transform": {"scale": [64.0, 64.0]},
        "fine_detail": "roughness",
    }
    ward = {"technique": "ward", **BLACK, "roughness_along": 0.1, "roughness_across": 0.1}

    shown = head_on(studio, {**ward, "bump": bump})

    wide = 0.01 + 2 * (0.16 / 2) * steepness**2
    facing = 1 / np.sqrt(1 + (0.1 * steepness) ** 2)
    slope = (1 - facing**2) / facing**2
    assert shown == pytest.approx(np.exp(-slope / wide) / (4 * np.pi * wide), rel=1e-4)


@pytest.mark.parametrize("kind", ["normal", "bump"])
def test_a_flat_map_changes_nothing(studio: Studio, kind: str) -> None:
    held = [0.0, 0.0, 1.0] if kind == "normal" else [0.0, 0.0]
    how = {"range": "signed"} if kind == "normal" else {"encoding": "float"}
    flat = {kind: {"texture": studio.texture([[held]]), "fine_detail": "roughness", **how}}

    for technique in ("phong", "ward", "metallic_roughness"):
        surface = {"technique": technique}
        assert head_on(studio, {**surface, **flat}) == head_on(studio, surface)


def test_without_it_far_bumps_are_lost(studio: Studio) -> None:
    ward = {"technique": "ward", **BLACK, "roughness_along": 0.1, "roughness_across": 0.1}

    shown = head_on(studio, {**ward, **ridged(studio, fine_detail="lost")})

    assert shown == pytest.approx(1 / (4 * np.pi * 0.01), rel=1e-4)


def bumpy(side: int, slope: float) -> NDArray[np.float64]:
    """Normals (side, side, 3) whose slopes are Gaussian, with this deviation along each axis."""
    slopes = np.random.default_rng(21).normal(0.0, slope, (side, side, 2))
    normals = np.concatenate([-slopes, np.ones((side, side, 1))], axis=-1)
    return normals / np.linalg.norm(normals, axis=-1, keepdims=True)


@pytest.mark.parametrize("technique", ["ward", "metallic_roughness", "phong"])
def test_x21_one_sample_shows_the_mean_of_a_thousand(studio: Studio, technique: str) -> None:
    # 128 x 128 texels, seen one by one or by their mean in each of 4 x 4 pixels
    surface: dict[str, Any] = {
        "ward": {**BLACK, "roughness_along": 0.08, "roughness_across": 0.08},
        "metallic_roughness": {"roughness": 0.3},
        "phong": {**BLACK, "specular_weight": 1.0, "exponent": 100.0},
    }[technique]
    normal = {"texture": studio.texture(bumpy(128, 0.15)), "range": "signed"}
    far = {**normal, "filter": "trilinear", "fine_detail": "roughness"}
    lost = {**normal, "filter": "trilinear"}
    near = {**normal, "filter": "nearest"}

    def mean(mapped: dict[str, Any], light: Any, side: int) -> float:
        worn = {"technique": technique, **surface, "normal": mapped}
        lamp = {"type": "directional", "direction": list(-light)}
        drawn = studio.poster(worn, (side, side), lights=[lamp])
        return float(drawn[..., 1].mean())

    worst = {"far": 0.0, "lost": 0.0}
    for lean in (0.0, 0.2, 0.5):
        light = unit([lean, 0.0, 1.0])
        truth = mean(near, light, 128)
        for name, mapped in (("far", far), ("lost", lost)):
            worst[name] = max(worst[name], abs(mean(mapped, light, 4) / truth - 1))
    # Of Gaussian slopes Ward's model is one more; GGX, whose tails are longer, is less like them.
    assert worst["far"] < (0.3 if technique == "metallic_roughness" else 0.15)
    assert worst["lost"] > 5


def test_what_is_no_number_and_what_has_no_length_stays_finite(studio: Studio) -> None:
    texels = np.zeros((4, 4, 3))
    texels[0, 0], texels[1, 1], texels[2, 2] = np.nan, np.inf, 1e38
    for kind, how in (("normal", {"range": "signed"}), ("bump", {"encoding": "float"})):
        mapped = {"texture": studio.texture(texels), "fine_detail": "roughness", **how}
        for technique in ("phong", "ward", "metallic_roughness"):
            shown = studio.poster({"technique": technique, kind: mapped}, lights=[FRONT])
            assert np.isfinite(shown).all()


def test_x21_aslant_it_is_the_wider_lobe(studio: Studio) -> None:
    light = unit([0.7, 0.2, 1.0])
    metal = {"technique": "metallic_roughness", "roughness": 0.3, **ridged(studio)}
    lamp = {"type": "directional", "direction": list(-light)}

    shown = float(studio.poster(metal, (4, 4), lights=[lamp])[1, 1, 1])

    expected = lobe(NORMAL, light, float(np.sqrt(0.0081 + 2 * VARIANCE)), 0.0, 0.0) * light[2]
    assert shown == pytest.approx(expected, rel=1e-4)
