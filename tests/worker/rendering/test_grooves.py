"""Grooves finer than a pixel as streaks (X21, LEAN mapping), against closed forms and many samples.

A corrugation h = a sin(k x) has slopes of variance a^2 k^2 / 2 across and none along.
"""

import math
from typing import Any

import numpy as np
import pytest

from tests.worker.rendering.studio import Studio
from tests.worker.rendering.test_anisotropic_highlights import NORMAL, Floats, lit, seen, unit

pytestmark = pytest.mark.gl

TEXELS = 32
SLOPE = 0.3  # the steepest, a k
VARIANCE = SLOPE**2 / 2
PHASE = 2 * np.pi * (np.arange(TEXELS) + 0.5) / TEXELS
TILES = 200.0  # on a square that is 2 wide
ALPHA = 0.09
METAL: dict[str, Any] = {"technique": "metallic_roughness", "roughness": 0.3}
LIGHTS = [NORMAL, unit([0.5, 0, 1]), unit([0, 0.5, 1]), unit([0.4, 0.4, 1]), unit([-0.4, 0.4, 1])]


def lobe(view: Floats, light: Floats, squared: Floats) -> float:
    """D V n.l of GGX whose alpha^2 is a 2 x 2 matrix, as the plane's x and y have it.

    D = 1 / (pi sqrt(det) (h_z^2 + h^T A^-1 h)^2) and Lambda of Smith with |A^1/2 v| (Heitz, 2014).
    """
    h = unit(view + light)
    spread = h[2] ** 2 + h[:2] @ np.linalg.inv(squared) @ h[:2]
    distribution = 1 / (np.pi * np.sqrt(np.linalg.det(squared)) * spread**2)

    def side(v: Floats) -> float:
        return float(np.sqrt(v[:2] @ squared @ v[:2] + v[2] ** 2))

    return float(distribution * 0.5 * light[2] / (light[2] * side(view) + view[2] * side(light)))


def corrugation(studio: Studio, kind: str, **how: Any) -> dict[str, Any]:
    """A map of grooves along v, as heights, as tilts or as normals."""
    slopes = SLOPE * np.cos(PHASE)
    far = {"filter": "trilinear", "fine_detail": "streaks", **how}
    far.setdefault("transform", {"scale": [TILES, TILES]})
    if kind == "height":
        # Central differences of a sine are sin(d) / d of its slopes; the depth is in units of 1.
        step = 2 * np.pi / TEXELS
        depth = SLOPE / (np.pi * TILES) * step / np.sin(step)
        texture = studio.texture(np.sin(PHASE)[None, :].repeat(4, 0))
        return {"height": {"texture": texture, "depth": depth, **far}}
    if kind == "bump":
        tilts = np.stack([-slopes, 0 * slopes], axis=-1)
        texture = studio.texture(tilts[None].repeat(4, 0))
        return {"bump": {"texture": texture, "encoding": "float", **far}}
    normals = np.stack([-slopes, 0 * slopes, 1 + 0 * slopes], axis=-1)
    normals /= np.linalg.norm(normals, axis=-1, keepdims=True)
    texture = studio.texture(normals[None].repeat(4, 0))
    return {"normal": {"texture": texture, "range": "signed", **far}}


KINDS = ("height", "bump", "normal")


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("view", [NORMAL, unit([0.4, -0.3, 0.8])])
def test_x21_grooves_far_away_are_a_lobe_that_is_wide_across_them(
    studio: Studio, kind: str, view: Floats
) -> None:
    squared = np.diag([ALPHA**2 + 2 * VARIANCE, ALPHA**2])

    for light in LIGHTS:
        shown = lit(studio, METAL | corrugation(studio, kind), view, light)[1]
        assert shown == pytest.approx(lobe(view, light, squared), rel=2e-3)


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("turn", [0.5, math.pi / 2, -2.2])
def test_x21_the_streak_turns_with_the_picture(studio: Studio, kind: str, turn: float) -> None:
    # Coordinates that turn counter-clockwise turn the picture clockwise.
    across = np.array([np.cos(turn), -np.sin(turn)])
    squared = ALPHA**2 * np.eye(2) + 2 * VARIANCE * np.outer(across, across)
    turned = {"transform": {"scale": [TILES, TILES], "rotation": turn}}

    for light in LIGHTS:
        surface = METAL | corrugation(studio, kind, **turned)
        shown = lit(studio, surface, NORMAL, light)[1]
        assert shown == pytest.approx(lobe(NORMAL, light, squared), rel=2e-3)


def test_x21_grooves_across_a_streak_of_its_own_add_to_it(studio: Studio) -> None:
    # KHR_materials_anisotropy: alpha_t^2 along 0.6 radians, alpha_b^2 across, and the relief's
    wide = ALPHA + (1 - ALPHA) * 0.3**2
    t, b = np.array([np.cos(0.6), np.sin(0.6)]), np.array([-np.sin(0.6), np.cos(0.6)])
    squared = wide**2 * np.outer(t, t) + ALPHA**2 * np.outer(b, b) + np.diag([2 * VARIANCE, 0])
    own = {"anisotropy_strength": 0.3, "anisotropy_rotation": 0.6}

    for light in LIGHTS:
        shown = lit(studio, METAL | own | corrugation(studio, "bump"), NORMAL, light)[1]
        assert shown == pytest.approx(lobe(NORMAL, light, squared), rel=1e-3)


def test_x21_several_reliefs_add_up(studio: Studio) -> None:
    crossing = {"transform": {"scale": [TILES, TILES], "rotation": math.pi / 2}}
    both = corrugation(studio, "bump") | corrugation(studio, "height", **crossing)
    squared = (ALPHA**2 + 2 * VARIANCE) * np.eye(2)

    for light in LIGHTS:
        shown = lit(studio, METAL | both, NORMAL, light)[1]
        assert shown == pytest.approx(lobe(NORMAL, light, squared), rel=2e-3)


@pytest.mark.parametrize("fine_detail", ["roughness", "streaks"])
@pytest.mark.parametrize("technique", ["phong", "metallic_roughness"])
def test_x21_heights_widen_round_highlights_by_half_their_variance(
    studio: Studio, technique: str, fine_detail: str
) -> None:
    if technique == "metallic_roughness" and fine_detail == "streaks":
        return  # tested above: it has streaks
    half = VARIANCE / 2
    black: dict[str, Any] = {"diffuse_color": [0, 0, 0], "specular_color": [1, 1, 1]}
    phong = {"technique": "phong", **black, "exponent": 80.0, "specular_weight": 1.0}
    surface, expected = {
        "metallic_roughness": (METAL, lobe(NORMAL, NORMAL, (ALPHA**2 + 2 * half) * np.eye(2))),
        "phong": (phong | {"normalization": "energy"}, (80 / (1 + 320 * half) + 2) / (2 * np.pi)),
    }[technique]

    grooved = surface | corrugation(studio, "height", fine_detail=fine_detail)

    assert lit(studio, grooved, NORMAL, NORMAL)[1] == pytest.approx(expected, rel=2e-3)


@pytest.mark.parametrize("technique", ["ward", "ashikhmin_shirley"])
def test_x21_brushed_surfaces_have_streaks_too(studio: Studio, technique: str) -> None:
    # Head-on: Ward's 1 / (4 pi ax ay); sqrt((nu + 1)(nv + 1)) / (8 pi) with n' = n / (1 + n s^2)
    black: dict[str, Any] = {"diffuse_color": [0, 0, 0], "specular_color": [1, 1, 1]}
    wide = math.sqrt(0.01 + 2 * VARIANCE)
    surface, expected = {
        "ward": (
            {"roughness_along": 0.1, "roughness_across": 0.1},
            1 / (4 * np.pi * wide * 0.1),
        ),
        "ashikhmin_shirley": (
            {"exponent_along": 200.0, "exponent_across": 200.0},
            math.sqrt((200 / (1 + 200 * VARIANCE) + 1) * 201) / (8 * np.pi),
        ),
    }[technique]
    surface = {"technique": technique, **black, **surface}

    shown = lit(studio, surface | corrugation(studio, "bump"), NORMAL, NORMAL)[1]

    assert shown == pytest.approx(expected, rel=1e-3)


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("technique", ["ward", "metallic_roughness"])
def test_x21_one_sample_is_nearer_to_many_than_a_round_lobe_is(
    studio: Studio, technique: str, kind: str
) -> None:
    # Grooves of Gaussian slopes, seen one by one or by their means in 4 x 4 pixels
    slopes = np.random.default_rng(7).normal(0.0, 0.2, 128)[None, :].repeat(128, 0)
    if kind == "height":
        # Heights whose central differences, per tile of 128 texels on a square of 2, are these
        heights = np.zeros(128)
        heights[2::2] = np.cumsum(slopes[0, 1:-2:2])
        heights[3::2] = np.cumsum(slopes[0, 2:-1:2])
        texture = studio.texture((heights * 2 * 2 / 128)[None, :].repeat(128, 0))
        worn: dict[str, Any] = {"texture": texture, "depth": 1.0, "wrap": ["clamp", "repeat"]}
    elif kind == "bump":
        texture = studio.texture(np.stack([-slopes, 0 * slopes], axis=-1))
        worn = {"texture": texture, "encoding": "float"}
    else:
        normals = np.stack([-slopes, 0 * slopes, 1 + 0 * slopes], axis=-1)
        worn = {"texture": studio.texture(normals), "range": "signed"}

    def mean(light: Floats, side: int, **how: Any) -> float:
        lamp = {"type": "directional", "direction": list(-light)}
        drawn = studio.poster(surface | {kind: worn | how}, (side, side), lights=[lamp])
        return float(drawn[..., 1].mean())

    ward = {"technique": "ward", "diffuse_color": [0, 0, 0], "specular_color": [1, 1, 1]}
    ward |= {"roughness_along": 0.1, "roughness_across": 0.1}
    surface = ward if technique == "ward" else METAL
    worst, peak = {"streaks": 0.0, "roughness": 0.0}, 0.0
    for light in LIGHTS[:3]:
        truth = mean(light, 128, filter="nearest")
        for fine in worst:
            shown = mean(light, 4, filter="trilinear", fine_detail=fine)
            worst[fine] = max(worst[fine], abs(shown - truth))
            peak = max(peak, truth)
    # 32 slopes a pixel are Gaussian to a tenth; the edges of the heights are steeper.
    assert worst["streaks"] < 0.16 * peak
    assert worst["roughness"] > 2.5 * worst["streaks"]


@pytest.mark.parametrize("kind", KINDS)
def test_flat_grooves_change_nothing(studio: Studio, kind: str) -> None:
    flat: dict[str, Any] = {
        "height": {"texture": studio.texture([[0.4]])},
        "bump": {"texture": studio.texture([[[0.0, 0.0]]]), "encoding": "float"},
        "normal": {"texture": studio.texture([[[0.0, 0.0, 1.0]]]), "range": "signed"},
    }[kind]
    for technique in ("metallic_roughness", "ward", "phong"):
        surface = {"technique": technique}
        shown = lit(studio, surface | {kind: flat | {"fine_detail": "streaks"}}, NORMAL, LIGHTS[3])
        plain = lit(studio, surface, NORMAL, LIGHTS[3])
        np.testing.assert_allclose(shown, plain, rtol=1e-5)


@pytest.mark.parametrize("kind", KINDS)
def test_what_is_no_number_stays_finite(studio: Studio, kind: str) -> None:
    texels = np.zeros((4, 4, 3))
    texels[0, 0], texels[1, 1], texels[2, 2], texels[3, 3] = np.nan, np.inf, 1e38, -1e20
    how = {"height": {}, "bump": {"encoding": "float"}, "normal": {"range": "signed"}}[kind]
    mapped = {"texture": studio.texture(texels), "fine_detail": "streaks", **how}
    for technique in ("metallic_roughness", "ward", "ashikhmin_shirley", "phong"):
        lamp = {"type": "directional", "direction": [0.3, 0.1, -1.0]}
        shown = studio.poster({"technique": technique, kind: mapped}, lights=[lamp])
        assert np.isfinite(shown).all()


def test_x21_heights_vary_as_the_shape_is_stretched(studio: Studio) -> None:
    # Twice as long, half as high, half as wide: slopes of a quarter along x, as they were along y
    crossing = {"transform": {"scale": [TILES, TILES], "rotation": math.pi / 2}}
    stretched = {"scale": [2.0, 0.5, 0.5]}

    for how, squared in (
        ({}, np.diag([ALPHA**2 + 2 * VARIANCE / 16, ALPHA**2])),
        (crossing, np.diag([ALPHA**2, ALPHA**2 + 2 * VARIANCE])),
    ):
        surface = METAL | corrugation(studio, "height", **how)
        nodes = [{"mesh": {"type": "plane"}, "surface": surface, "transform": stretched}]
        for light in LIGHTS:
            lamp = {"type": "directional", "direction": list(-light)}
            shown = seen(studio, surface, NORMAL, nodes=nodes, lights=[lamp])[1]
            assert shown == pytest.approx(lobe(NORMAL, light, squared), rel=2e-3)


def test_x21_mirrored_copies_of_slanting_grooves_slant_the_other_way(studio: Studio) -> None:
    # One tile holds grooves at 45 degrees, its mirror image the others: a pixel of each
    across = (np.arange(64) + 0.5) / 64
    heights = np.sin(2 * np.pi * 8 * (across[None, :] - across[:, None]))  # rows run downwards
    mapped = {
        "texture": studio.texture(heights),
        "depth": 0.01,
        "wrap": ["mirror", "mirror"],
        "filter": "trilinear",
        "fine_detail": "streaks",
        "transform": {"scale": [2.0, 1.0]},
    }
    lamps = [{"type": "directional", "direction": [-x, -0.5, -1.0]} for x in (0.5, -0.5)]

    first, second = (
        studio.poster(METAL | {"height": mapped}, (4, 4), lights=[lamp])[..., 1] for lamp in lamps
    )

    np.testing.assert_allclose(first, second[:, ::-1], rtol=1e-3)
    assert (first[:, 1] > 3 * first[:, 2]).all() or (first[:, 2] > 3 * first[:, 1]).all()
