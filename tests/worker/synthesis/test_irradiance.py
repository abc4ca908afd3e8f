"""Irradiance by nine harmonics and by the whole sum (T36), against closed forms and tables."""

import math

import numpy as np
import pytest

from tests.worker.synthesis.spheres import directions, picture, run
from worker.synthesis import _pieces
from worker.synthesis._cube import face_directions, face_solid_angles
from worker.synthesis._harmonics import NAMES, basis, irradiance, matrix, project
from worker.synthesis._lobes import phong

# Ramamoorthi and Hanrahan, 2001, table 1, Grace Cathedral, two digits (A10 of the reference)
GRACE = np.array(
    [
        [0.79, 0.44, 0.54],
        [0.39, 0.35, 0.60],
        [-0.34, -0.18, -0.27],
        [-0.29, -0.06, 0.01],
        [-0.11, -0.05, -0.12],
        [-0.26, -0.22, -0.47],
        [-0.16, -0.09, -0.15],
        [0.56, 0.21, 0.14],
        [0.21, -0.05, -0.30],
    ]
)
UP, OBLIQUE = [0.0, 1.0, 0.0], [0.48, 0.6, 0.64]
PUBLISHED = [[1.04875150, 0.79185055, 1.25842848], [0.58847244, 0.42566819, 0.53560310]]
POLE = {"technique": "latlong"}


def test_t36_a10_graces_table_gives_the_published_irradiance():
    found = irradiance(GRACE, np.array([UP, OBLIQUE]))

    # The published constants c1..c5 have six digits, of sums of about 2.
    np.testing.assert_allclose(found, PUBLISHED, atol=5e-6)


def test_t36_the_matrix_is_the_sum_of_harmonics():
    normals = np.array([UP, OBLIQUE, [-0.6, 0.0, 0.8]])
    ones = np.append(normals, np.ones((3, 1)), axis=1)

    for channel in range(3):
        m = matrix(GRACE[:, channel])
        np.testing.assert_array_equal(m, m.T)
        expected = irradiance(GRACE, normals)[:, channel]
        np.testing.assert_allclose(np.einsum("ni,ij,nj->n", ones, m, ones), expected, rtol=1e-12)


def test_t36_the_matrix_has_the_published_constants():
    # c1, c2, c3, c4 and c5 of the paper, more digits from the closed forms
    c1, c2, c3, c4, c5 = 0.4290427654, 0.5116633540, 0.7431238683, 0.8862269255, 0.2477079561
    zonal, constant = np.zeros(9), np.zeros(9)
    zonal[NAMES.index("L20")] = 1
    constant[NAMES.index("L00")] = 1

    np.testing.assert_allclose(np.diag(matrix(zonal)), [0, 0, c3, -c5], atol=1e-9)
    assert matrix(constant)[3, 3] == pytest.approx(c4, abs=1e-9)
    for name, place, value in (("L2-2", (0, 1), c1), ("L21", (0, 2), c1), ("L11", (0, 3), c2)):
        one = np.zeros(9)
        one[NAMES.index(name)] = 1
        assert matrix(one)[place] == pytest.approx(value, abs=1e-9)


def test_t36_the_harmonics_are_orthonormal():
    side = 64
    weights = np.tile(face_solid_angles(side).ravel(), 6)
    values = basis(face_directions(side).reshape(-1, 3))

    # The midpoint rule on texels of 1.4 degrees
    np.testing.assert_allclose(values.T @ (values * weights[:, None]), np.eye(9), atol=1e-4)


def test_t36_a11_a_cosine_sky_misses_by_what_is_known():
    image = picture(lambda d: np.maximum(d[:, 2], 0), (512, 256), fine=1)

    report = run({"technique": "irradiance"}, (8, 4), image).report
    coefficients = np.array([report["coefficients"][name] for name in NAMES])
    found = irradiance(coefficients, np.array([[0, 0, 1.0], [0, 1.0, 0], [0, 0, -1.0]]))[:, 0]

    np.testing.assert_allclose(found, [2.078033, 0.662680, -0.016363], atol=2e-4)
    # They miss pi / 192 at both poles, and the mean of E is pi / 4; probes are near the poles only.
    assert report["harmonics_error_max"] == pytest.approx(4 / 192, rel=0.2)


def test_t09_the_sum_over_all_texels_is_the_integral_in_closed_form():
    side = 64
    faces = np.repeat(np.maximum(face_directions(side)[..., 2:], 0), 3, axis=-1)
    light = _pieces.pieces(faces.astype(np.float32))
    normals = np.array([[0, 0, 1.0], [1.0, 0, 0], [0, 0, -1.0]])

    for share, error in ((_pieces.EVERY_TEXEL, 1e-3), (_pieces.SHARE, 1e-2)):
        found = math.pi * _pieces.sums(light, phong(1.0), normals, share)[:, 0]
        # E = 2 pi / 3 up, 2 / 3 at the horizon, 0 down; texels of 1.4 degrees
        np.testing.assert_allclose(found, [2 * math.pi / 3, 2 / 3, 0], atol=error)


@pytest.mark.parametrize("method", ["harmonics", "sum"])
def test_half_a_sky_lights_what_faces_it(method):
    image = picture(lambda d: (d[:, 1] > 0).astype(float), (128, 64))
    size = (16, 8)

    shown = run({"technique": "irradiance", "method": method}, size, image).image.pixels[..., 0]

    # E / pi = (1 + sin(latitude)) / 2; nine harmonics are exact for it, but for rounding
    expected = (1 + directions(POLE, size)[..., 1]) / 2
    np.testing.assert_allclose(shown, expected, atol=6e-3)


@pytest.mark.parametrize("method", ["harmonics", "sum"])
def test_a_constant_sky_stays_constant(method):
    image = picture(lambda d: np.full((len(d), 3), [0.25, 1.0, 4.0]), (64, 32), fine=1)

    shown = run({"technique": "irradiance", "method": method}, (16, 8), image)

    np.testing.assert_allclose(shown.image.pixels, np.broadcast_to([0.25, 1, 4], (8, 16, 3)), 1e-3)
    assert shown.report["coefficients"]["L00"][1] == pytest.approx(math.sqrt(4 * math.pi), 1e-6)


def test_coefficients_in_the_place_of_a_picture():
    spec = {"technique": "irradiance", "coefficients": GRACE.tolist()}

    made = run(spec, (32, 16))

    shown, normals = made.image.pixels, directions(POLE, (32, 16)).reshape(-1, 3)
    expected = np.maximum(irradiance(GRACE, normals) / math.pi, 0).reshape(16, 32, 3)
    np.testing.assert_allclose(shown, expected, rtol=1e-6)
    np.testing.assert_allclose([made.report["coefficients"][n] for n in NAMES], GRACE)


def test_a_sky_stored_upside_down_is_named():
    upright = picture(lambda d: 1 + d[:, 1], (64, 32))
    turned = type(upright)(upright.pixels[::-1].copy(), "colour")

    told = [run({"technique": "irradiance"}, (4, 2), image).report for image in (upright, turned)]

    # L1-1 / L00 of 1 + y is 1 / sqrt(3)
    assert told[0]["light_from_above"] == pytest.approx(1 / math.sqrt(3), rel=2e-3)
    assert not told[0]["upside_down"]
    assert told[1]["light_from_above"] == pytest.approx(-1 / math.sqrt(3), rel=2e-3)
    assert told[1]["upside_down"]


def test_projection_finds_coefficients_that_were_put_in():
    side = 32
    towards = face_directions(side).reshape(-1, 3)
    weights = np.tile(face_solid_angles(side).ravel(), 6)

    found = project(basis(towards) @ GRACE, towards, weights)

    np.testing.assert_allclose(found, GRACE, atol=2e-3)
