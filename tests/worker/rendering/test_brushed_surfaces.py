"""Surfaces that look different along and across (T65), against their formulas in numpy."""

import numpy as np
import pytest

from tests.worker.rendering.studio import Studio

pytestmark = pytest.mark.gl

FRONT = {"type": "directional", "direction": [0.0, 0.0, -3.0]}
# The sphere's frame (T14) at longitude pi / 3 and latitude pi / 6
ALONG = np.array([-np.sqrt(3) / 2, 0.0, 0.5])
NORMAL = np.array([np.sqrt(3) / 4, 0.5, 0.75])
ACROSS = np.cross(NORMAL, ALONG)
VIEW = np.ones(3) / np.sqrt(3)
BLACK = {"diffuse_color": [0.0, 0.0, 0.0]}


def seen(studio, surface, mirrored=None, light=None, view=VIEW):
    """One pixel of a square that lies along ALONG and ACROSS, seen from far in the direction view.

    The light comes from `light`, or so that it is reflected towards `mirrored`.
    """
    if light is None:
        light = 2 * (NORMAL @ mirrored) * NORMAL - mirrored
    placed = np.eye(4)
    placed[:3, :3] = np.column_stack([ALONG, ACROSS, NORMAL])
    scene = {
        "camera": {
            "type": "orthographic",
            "height": 0.2,
            "pose": {"eye": list(5 * view), "target": [0.0, 0.0, 0.0]},
        },
        "lights": [{"type": "directional", "direction": list(-np.asarray(light))}],
        "nodes": [
            {
                "mesh": {"type": "plane"},
                "transform": {"matrix": list(placed.T.ravel())},
                "surface": surface,
            }
        ],
    }
    return studio.draw(scene, (1, 1))[0, 0, :3]


@pytest.mark.parametrize(
    ("along", "across", "product"),
    [(0.2, 1.0, 0.661880215), (0.2, 0.5, 0.684756803), (1.0, 1.0, 0.577350269)],
)
def test_a17_the_dot_product_of_brushed_metal(studio: Studio, along, across, product):
    surface = {
        "technique": "brushed_metal",
        **BLACK,
        "specular_color": [1.0, 1.0, 1.0],
        "exponent": 1.0,
        "along": along,
        "across": across,
    }
    # Ten products of float32 numbers below 1.
    np.testing.assert_allclose(
        seen(studio, surface, mirrored=np.array([0.0, 0.0, 1.0])), product, atol=1e-6
    )


@pytest.mark.parametrize(("along", "across"), [(0.0, 0.0), (-1.0, 0.0), (-1e30, -1e-30)])
def test_a17_a_singular_matrix_keeps_what_is_upright(studio: Studio, along, across):
    # V diag(0, 0, 1) V^T = n n^T; below zero is cut off
    surface = {
        "technique": "brushed_metal",
        **BLACK,
        "specular_color": [1.0, 1.0, 1.0],
        "exponent": 1.0,
        "along": along,
        "across": across,
    }
    towards = np.array([0.0, 0.0, 1.0])
    product = (NORMAL @ VIEW) * (NORMAL @ towards)
    np.testing.assert_allclose(seen(studio, surface, mirrored=towards), product, atol=1e-6)


def test_a_singular_matrix_seen_along_the_surface_is_dark_and_a_number(studio: Studio):
    surface = {"technique": "brushed_metal", **BLACK, "along": 0.0, "across": 0.0, "exponent": 0.5}
    slant = NORMAL * 1e-3 + ALONG
    drawn = seen(studio, surface, light=NORMAL, view=slant / np.linalg.norm(slant))
    assert np.isfinite(drawn).all()
    assert (drawn < 0.1).all()


def test_a17_turned_scratches_swap_the_axes(studio: Studio):
    surface = {
        "technique": "brushed_metal",
        **BLACK,
        "specular_color": [1.0, 1.0, 1.0],
        "exponent": 1.0,
        "along": 0.5,
        "across": 0.2,
        "angle": np.pi / 2,
    }
    turned = seen(studio, surface, mirrored=np.array([0.0, 0.0, 1.0]))
    np.testing.assert_allclose(turned, 0.684756803, atol=1e-6)


def test_brushed_metal_without_scratches_is_phong(studio: Studio):
    mirrored = np.array([0.36, 0.48, 0.8])
    parts = {"diffuse_color": [0.2, 0.3, 0.4], "specular_color": [0.9, 0.8, 0.7], "exponent": 20.0}
    brushed = seen(
        studio, {"technique": "brushed_metal", "along": 1.0, "across": 1.0, **parts}, mirrored
    )
    phong = seen(studio, {"technique": "phong", "specular_weight": 1.0, **parts}, mirrored)
    # Two orders of adding three products differ by 2^-23 or so, which the power makes 20 times it.
    np.testing.assert_allclose(brushed, phong, rtol=20 * 2**-22)


def test_t65_ward_head_on(studio: Studio):
    # 1 / (4 pi 0.15 0.5)
    surface = {
        "technique": "ward",
        **BLACK,
        "specular_color": [1.0, 1.0, 1.0],
        "roughness_along": 0.15,
        "roughness_across": 0.5,
    }
    drawn = studio.poster(surface, lights=[FRONT])
    np.testing.assert_allclose(drawn[..., :3], 1.061032954, rtol=1e-6)


def test_t65_ward_aslant(studio: Studio):
    light = np.array([0.8, 0.36, 0.48])
    surface = {
        "technique": "ward",
        "diffuse_color": [0.5, 0.25, 0.125],
        "specular_color": [0.3, 0.6, 0.9],
        "roughness_along": 0.4,
        "roughness_across": 0.7,
    }
    half_way = (light + VIEW) / np.linalg.norm(light + VIEW)
    facing, looking, upright = NORMAL @ light, NORMAL @ VIEW, NORMAL @ half_way
    angle = np.arctan2(half_way @ ACROSS, half_way @ ALONG)
    slope = np.tan(np.arccos(upright)) ** 2
    slope *= np.cos(angle) ** 2 / 0.4**2 + np.sin(angle) ** 2 / 0.7**2
    lobe = np.exp(-slope) / (4 * np.pi * 0.4 * 0.7 * np.sqrt(facing * looking))
    colours = np.array([0.5, 0.25, 0.125]), np.array([0.3, 0.6, 0.9])
    expected = (colours[0] / np.pi + colours[1] * lobe) * facing
    np.testing.assert_allclose(seen(studio, surface, light=light), expected, rtol=3e-6)


def test_t65_ashikhmin_shirley_head_on(studio: Studio):
    gloss = {"exponent_along": 100.0, "exponent_across": 100.0}
    surface = {
        "technique": "ashikhmin_shirley",
        **BLACK,
        "specular_color": [1.0, 1.0, 1.0],
        **gloss,
    }
    drawn = studio.poster(surface, lights=[FRONT])
    np.testing.assert_allclose(drawn[..., :3], 4.018662313, rtol=1e-6)


def test_t65_the_matt_part_of_ashikhmin_shirley_head_on(studio: Studio):
    # Seen and lit head-on the glossy part is Rs sqrt(1) / 8 pi with both exponents 0.
    surface = {
        "technique": "ashikhmin_shirley",
        "diffuse_color": [0.5, 0.5, 0.5],
        "specular_color": [0.05, 0.05, 0.05],
        "exponent_along": 0.0,
        "exponent_across": 0.0,
    }
    drawn = studio.poster(surface, lights=[FRONT])
    np.testing.assert_allclose(drawn[..., :3], 0.172741769 + 0.05 / (8 * np.pi), rtol=1e-6)


def test_t65_ashikhmin_shirley_aslant(studio: Studio):
    light = np.array([0.8, 0.36, 0.48])
    nu, nv, gloss, matt = 30.0, 8.0, 0.25, np.array([0.5, 0.25, 0.125])
    surface = {
        "technique": "ashikhmin_shirley",
        "diffuse_color": list(matt),
        "specular_color": [gloss] * 3,
        "exponent_along": nu,
        "exponent_across": nv,
    }
    half_way = (light + VIEW) / np.linalg.norm(light + VIEW)
    facing, looking = NORMAL @ light, NORMAL @ VIEW
    upright, met = NORMAL @ half_way, half_way @ VIEW
    power = (nu * (half_way @ ALONG) ** 2 + nv * (half_way @ ACROSS) ** 2) / (1 - upright**2)
    lobe = np.sqrt((nu + 1) * (nv + 1)) / (8 * np.pi) * upright**power
    lobe *= (gloss + (1 - gloss) * (1 - met) ** 5) / (met * max(facing, looking))
    below = 28 * matt / (23 * np.pi) * (1 - gloss)
    below *= (1 - (1 - facing / 2) ** 5) * (1 - (1 - looking / 2) ** 5)
    expected = (below + lobe) * facing
    # The power of some 20 multiplies the relative error of n.h, 2^-23.
    np.testing.assert_allclose(seen(studio, surface, light=light), expected, rtol=1e-5)


@pytest.mark.parametrize("technique", ["brushed_metal", "ward", "ashikhmin_shirley"])
def test_the_streak_lies_across_the_tight_direction(studio: Studio, technique):
    # A ball lit from the eye: its highlight is longer along the direction that fades less.
    tight = {
        "brushed_metal": {"along": 1.0, "across": 0.0},
        "ward": {"roughness_along": 0.1, "roughness_across": 0.5},
        "ashikhmin_shirley": {"exponent_along": 400.0, "exponent_across": 10.0},
    }[technique]
    surface = {"technique": technique, **BLACK, "specular_color": [1.0, 1.0, 1.0], **tight}
    drawn = studio.draw(
        {
            "camera": {"type": "orthographic", "height": 2.0, "pose": {"eye": [0, 0, 3]}},
            "lights": [FRONT],
            "nodes": [{"mesh": {"type": "sphere", "radius": 1.0}, "surface": surface}],
        },
        (127, 127),
    )[..., 0]
    bright = drawn > 0.5 * drawn[63, 63]
    # u runs round the poles: along is horizontal here. Of brushed metal, cos 2x stands against
    # cos^2 x, whose widths are as 1 to the root of 2; of the others the factor is 5 and more.
    assert bright[63].sum() < 0.8 * bright[:, 63].sum()
