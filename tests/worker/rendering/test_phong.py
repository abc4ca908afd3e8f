"""Reflected light against the formula written out in numpy."""

import numpy as np
import pytest

from api_schemas.lights import LIGHTS_MAX
from tests.worker.rendering.studio import Studio

pytestmark = pytest.mark.gl

FRONT = {"type": "directional", "direction": [0.0, 0.0, -3.0]}
SLANTED = {"type": "directional", "direction": [0.3, -0.2, -1.0]}
SURFACE = {
    "technique": "phong",
    "diffuse_weight": 0.5,
    "diffuse_color": [0.25, 0.5, 0.75],
    "specular_weight": 0.125,
    "specular_color": [1.0, 0.5, 2.0],
}


def test_head_on_it_is_exactly_kd_cd_plus_ks_cs(studio: Studio) -> None:
    # T06: n = l = v; all factors are short binary fractions, so float32 has no excuse.
    drawn = studio.poster(SURFACE, lights=[FRONT])

    expected = 0.5 * np.array([0.25, 0.5, 0.75]) + 0.125 * np.array([1.0, 0.5, 2.0])
    np.testing.assert_array_equal(drawn[..., :3], np.broadcast_to(expected, drawn[..., :3].shape))


def test_energy_normalisation_of_the_highlight(studio: Studio) -> None:
    # T06: (50 + 2) / 2 pi = 8.276057040778557
    drawn = studio.poster(
        {
            "technique": "phong",
            "diffuse_weight": 0.0,
            "specular_weight": 1.0,
            "exponent": 50.0,
            "normalization": "energy",
        },
        lights=[FRONT],
    )

    np.testing.assert_allclose(drawn[..., :3], 8.276057040778557, rtol=2e-7)


@pytest.mark.parametrize("normalization", ["none", "energy"])
@pytest.mark.parametrize("exponent", [0.0, 1.0, 32.0, 1000.0])
@pytest.mark.parametrize("direction", [[0.1, -0.2, -1.0], [3.0, 0.0, -1.0], [0.02, 0.0, -1.0]])
def test_slanting_light(
    studio: Studio, normalization: str, exponent: float, direction: list[float]
) -> None:
    drawn = studio.poster(
        {**SURFACE, "exponent": exponent, "normalization": normalization},
        (1, 1),
        lights=[{"type": "directional", "direction": direction, "irradiance": 2.5}],
    )[0, 0, :3]

    light = -np.array(direction) / np.linalg.norm(direction)
    facing = light[2]
    mirrored = 2 * facing * np.array([0, 0, 1]) - light
    matt = 0.5 * np.array([0.25, 0.5, 0.75])
    gloss = 0.125 * np.array([1.0, 0.5, 2.0]) * max(0, mirrored[2]) ** exponent
    if normalization == "energy":
        matt = matt / np.pi
        gloss = gloss * (exponent + 2) / (2 * np.pi) * facing
    # The power multiplies the relative error of r.v, some 2^-23, by the exponent.
    np.testing.assert_allclose(drawn, 2.5 * (matt * facing + gloss), rtol=1e-6 + 2**-22 * exponent)


@pytest.mark.parametrize("exponent", [0.5, 8.0, 60.0])
@pytest.mark.parametrize("angle", [0.05, 0.3, np.pi / 4, 0.8, 1.2])
def test_the_highlight_is_a_power_to_float_precision(
    studio: Studio, exponent: float, angle: float
) -> None:
    drawn = studio.poster(
        {
            "technique": "phong",
            "diffuse_weight": 0.0,
            "specular_weight": 1.0,
            "exponent": exponent,
        },
        (1, 1),
        lights=[{"type": "directional", "direction": [np.sin(angle), 0.0, -np.cos(angle)]}],
    )[0, 0, 0]

    # r.v = cos(angle) within 2^-24 relative, times the exponent; the logarithm adds as much.
    assert drawn == pytest.approx(np.cos(angle) ** exponent, rel=2e-7 + exponent * 2**-23)


@pytest.mark.parametrize("normalization", ["none", "energy"])
def test_what_a_map_reads_below_zero_is_an_exponent_of_zero(
    studio: Studio, normalization: str
) -> None:
    mapped = {"texture": studio.texture([[1.0]]), "scale": -1000.0}
    glossy = {**SURFACE, "normalization": normalization}

    np.testing.assert_array_equal(
        studio.poster({**glossy, "exponent": mapped}, lights=[SLANTED]),
        studio.poster({**glossy, "exponent": 0}, lights=[SLANTED]),
    )


def test_light_from_behind_gives_nothing(studio: Studio) -> None:
    drawn = studio.poster(SURFACE, lights=[{"type": "directional", "direction": [0.0, 0.0, 1.0]}])

    np.testing.assert_array_equal(drawn[..., :3], np.zeros_like(drawn[..., :3]))


def test_no_light_leaves_emission_alone(studio: Studio) -> None:
    drawn = studio.poster({**SURFACE, "emission": [4.0, 1e4, 0.25]})

    np.testing.assert_array_equal(drawn[5, 5], [4, 1e4, 0.25, 1])


def test_ambient_lights_add_up(studio: Studio) -> None:
    drawn = studio.poster(
        {"technique": "phong", "ambient_weight": 0.5, "ambient_color": [1.0, 0.5, 0.25]},
        lights=[
            {"type": "ambient", "radiance": [1.0, 2.0, 3.0]},
            {"type": "ambient", "radiance": [1.0, 0.0, 1.0]},
        ],
    )

    np.testing.assert_array_equal(drawn[3, 3, :3], [1.0, 0.5, 0.5])


def test_the_ambient_colour_is_the_matt_one_unless_given(studio: Studio) -> None:
    drawn = studio.poster(
        {"technique": "phong", "diffuse_color": [0.5, 0.25, 0.125]},
        lights=[{"type": "ambient", "radiance": [1.0, 1.0, 1.0]}],
    )

    np.testing.assert_array_equal(drawn[3, 3, :3], [0.5, 0.25, 0.125])


def test_point_light_falls_with_the_square_of_the_distance(studio: Studio) -> None:
    side = 64
    drawn = studio.poster(
        {"technique": "phong", "diffuse_color": [1.0, 1.0, 1.0]},
        (side, side),
        lights=[
            {
                "type": "point",
                "position": [0.25, -0.5, 0.75],
                "color": [1.0, 0.5, 0.0],
                "intensity": 3.0,
            }
        ],
    )

    place = (np.arange(side) + 0.5) / side * 2 - 1
    x, y = np.meshgrid(place, place[::-1])
    squared = (x - 0.25) ** 2 + (y + 0.5) ** 2 + 0.75**2
    expected = 3 * 0.75 / squared**1.5
    np.testing.assert_allclose(drawn[..., 0], expected, rtol=2e-6)
    np.testing.assert_allclose(drawn[..., 1], 0.5 * expected, rtol=2e-6)
    assert (drawn[..., 2] == 0).all()


def test_spot_light_is_full_inside_and_nothing_outside(studio: Studio) -> None:
    side, inner, outer = 64, 0.3, 0.6
    drawn = studio.poster(
        {"technique": "phong", "diffuse_color": [1.0, 1.0, 1.0]},
        (side, side),
        lights=[
            {
                "type": "spot",
                "position": [0.0, 0.0, 1.0],
                "direction": [0.0, 0.0, -2.0],
                "inner_angle": inner,
                "outer_angle": outer,
            }
        ],
    )[..., 0]

    place = (np.arange(side) + 0.5) / side * 2 - 1
    x, y = np.meshgrid(place, place)
    cosine = 1 / np.sqrt(1 + x**2 + y**2)
    # KHR_lights_punctual: the square of a ramp between the cosines
    ramp = np.clip((cosine - np.cos(outer)) / (np.cos(inner) - np.cos(outer)), 0, 1)
    np.testing.assert_allclose(drawn, cosine**3 * ramp**2, atol=2e-6)
    assert drawn[0, 0] == 0


def test_as_many_lights_as_there_may_be_are_so_many_times_one(studio: Studio) -> None:
    one = {**FRONT, "irradiance": 2.0 / LIGHTS_MAX}

    drawn = studio.poster(SURFACE, lights=[one] * LIGHTS_MAX)

    np.testing.assert_array_equal(
        drawn, studio.poster(SURFACE, lights=[{**FRONT, "irradiance": 2.0}])
    )


def test_both_sides_of_a_surface_are_lit(studio: Studio) -> None:
    behind = {
        "camera": {"type": "orthographic", "pose": {"eye": [0.0, 0.0, -2.0]}},
        "lights": [{"type": "directional", "direction": [0.0, 0.0, 1.0]}],
        "nodes": [{"mesh": {"type": "plane"}, "surface": SURFACE}],
    }

    np.testing.assert_array_equal(studio.draw(behind), studio.poster(SURFACE, lights=[FRONT]))


@pytest.mark.parametrize("scale", [[-1.0, 1.0, 1.0], [1.0, -2.0, 1.0], [-1.0, -1.0, -1.0]], ids=str)
def test_a_mirrored_ball_is_lit_from_the_same_side(studio: Studio, scale: list[float]) -> None:
    def ball(transform: dict[str, object]) -> np.ndarray:
        return studio.draw(
            {
                "camera": {"type": "orthographic", "height": 1.4, "pose": {"eye": [0.0, 0.0, 5.0]}},
                "lights": [{"type": "directional", "direction": [1.0, -1.0, -1.0]}],
                "nodes": [
                    {
                        "mesh": {"type": "sphere", "segments": 256, "rings": 128},
                        "transform": transform,
                        "surface": {"technique": "phong", "diffuse_color": [1.0, 1.0, 1.0]},
                    }
                ],
            }
        )

    drawn = ball({"scale": scale})

    # n is the analytic normal of the stretched ball x^2 + (y / s)^2 + z^2 = 1.
    place = ((np.arange(32) + 0.5) / 32 * 2 - 1) * 0.7
    x, y = np.meshgrid(place, place[::-1])
    stretched = y / scale[1]
    normal = np.stack([x, stretched / scale[1], np.sqrt(1 - x**2 - stretched**2)], axis=2)
    normal /= np.linalg.norm(normal, axis=2, keepdims=True)
    expected = np.maximum(normal @ np.array([-1, 1, 1]) / np.sqrt(3), 0)
    # Facets of 2 pi / 256 bend the normal's place by some 1e-3.
    np.testing.assert_allclose(drawn[..., 0], expected, atol=3e-3)


def test_a_surface_left_out_is_matt_grey(studio: Studio) -> None:
    scene = {
        "camera": {"type": "orthographic", "pose": {"eye": [0.0, 0.0, 2.0]}},
        "lights": [FRONT],
        "nodes": [{"mesh": {"type": "plane"}}],
    }

    assert (studio.draw(scene)[..., :3] == np.float32(0.8)).all()
