"""Prefiltered environments (T35) against closed forms and the sum over all texels (T09)."""

import numpy as np
import pytest

from tests.worker.synthesis.spheres import directions, picture, run
from worker.images.image import Image
from worker.synthesis import _pieces, _spiral
from worker.synthesis._cube import face_directions, face_solid_angles, pyramid
from worker.synthesis._lobes import ggx, phong
from worker.synthesis._prefilter import probes

TECHNIQUE = {"technique": "prefiltered_environment"}
CHAIN = [0.0, 0.1, 0.25, 0.5, 0.75, 1.0]
SUN = np.array([0.36, 0.48, 0.8])


def sunny(d):
    return 0.5 + 0.5 * d[:, 1] + 500.0 * (d @ SUN > 0.997)


def half_sky(d):
    return (d[:, 2] > 0).astype(float)


@pytest.mark.parametrize("lobes", [{"roughness": CHAIN}, {"exponents": [0, 1, 10, 300, 1e6]}])
def test_t35_a_constant_environment_stays_as_it_is(lobes):
    image = picture(lambda d: np.full((len(d), 3), [0.25, 1.0, 4.0]), (32, 16), fine=1)

    shown = run({**TECHNIQUE, **lobes}, (32, 32), image).image.pixels

    for index in range(len(next(iter(lobes.values())))):
        top, rows = 32 - (32 >> index), max(1, 16 >> index)
        if top + rows <= 32:
            panel = shown[top : top + rows, : max(1, 32 >> index)]
            np.testing.assert_allclose(panel, np.broadcast_to([0.25, 1, 4], panel.shape), 2e-6)


@pytest.mark.parametrize("lobe", [ggx(0.3), ggx(0.5), ggx(1.0), phong(0), phong(1), phong(40)])
def test_t35_half_a_sky_is_half_at_its_edge(lobe):
    faces = half_sky(face_directions(64).reshape(-1, 3)).reshape(6, 64, 64, 1)
    light = _pieces.pieces(np.repeat(faces, 3, axis=-1).astype(np.float32))
    angle = np.linspace(0, 2 * np.pi, 24, endpoint=False) + 0.1
    horizon = np.stack([np.cos(angle), np.sin(angle), np.zeros(24)], axis=1)

    found = _pieces.sums(light, lobe, horizon)

    np.testing.assert_allclose(found, 0.5, atol=6e-3)


@pytest.mark.parametrize(
    ("exponent", "mean"),
    # Of L = w.z round z: int x^(n+1) / int x^n = (n + 1) / (n + 2)
    [(0, 1 / 2), (1, 2 / 3), (8, 9 / 10), (98, 99 / 100)],
)
def test_t35_phongs_lobe_is_its_integral(exponent, mean):
    image = picture(lambda d: np.maximum(d[:, 2], 0), (256, 128))
    size = (64, 32)

    shown = run({**TECHNIQUE, "exponents": [exponent]}, size, image).image.pixels[..., 0]

    # The middle of the picture is +z; its four pixels are at most four degrees off.
    assert shown[15:17, 31:33].mean() == pytest.approx(mean, abs=5e-3)


@pytest.mark.parametrize("roughness", [0.15, 0.3, 0.5, 0.8, 1.0])
def test_t35_the_lobe_is_the_reflection_seen_head_on(roughness):
    # D V n.l with n = v, as glTF 2.0, appendix B, has them, over the sun and sky by brute force
    side = 128
    towards = face_directions(side).reshape(-1, 3)
    weights = np.tile(face_solid_angles(side).ravel(), 6)
    light = sunny(towards)
    axis = np.array([[0.0, 0.28, 0.96], [0.6, 0.0, 0.8]])
    alpha = roughness**2
    cosine = np.clip(axis @ towards.T, 0, 1)
    half = (axis[:, None] + towards) / np.linalg.norm(axis[:, None] + towards, axis=-1)[..., None]
    facing = np.clip(np.einsum("nkc,nc->nk", half, axis), 0, 1)
    d = alpha**2 / (np.pi * (facing**2 * (alpha**2 - 1) + 1) ** 2)
    smith = cosine * 1.0 + np.sqrt(cosine**2 * (1 - alpha**2) + alpha**2)
    lobe = d * 0.5 / smith * cosine * weights
    expected = (lobe * light).sum(axis=1) / lobe.sum(axis=1)

    faces = np.repeat(light.reshape(6, side, side, 1), 3, axis=-1).astype(np.float32)
    exact = _pieces.sums(_pieces.pieces(faces), ggx(roughness), axis, _pieces.EVERY_TEXEL)
    quick = _pieces.sums(_pieces.pieces(faces), ggx(roughness), axis)

    np.testing.assert_allclose(exact[:, 0], expected, rtol=1e-4)
    np.testing.assert_allclose(quick[:, 0], expected, rtol=3e-2)


def test_t35_no_roughness_is_the_environment_itself():
    image = picture(sunny, (64, 32))

    shown = run({**TECHNIQUE, "roughness": [0.0]}, (64, 32), image).image.pixels

    np.testing.assert_array_equal(shown, image.pixels)


def test_t35_the_narrowest_lobes_come_near_to_it():
    image = picture(lambda d: 1 + d[:, 0] * d[:, 1], (128, 64))

    for lobe in ({"roughness": [0.05]}, {"exponents": [2e4]}):
        shown = run({**TECHNIQUE, **lobe}, (128, 64), image).image.pixels
        np.testing.assert_allclose(shown, image.pixels, atol=4e-3)


def test_t35_narrow_lobes_are_read_as_wide_ones_are_added_up():
    side = 128
    light = np.abs(np.sin(3 * face_directions(side))).astype(np.float32)
    towards = probes(50)

    read = _spiral.gathered(pyramid(light), ggx(0.3), towards)
    added = _pieces.sums(_pieces.pieces(light), ggx(0.3), towards)

    np.testing.assert_allclose(read, added, atol=1e-2)


def test_t09_the_report_tells_the_error_and_the_error_can_be_seen():
    image = picture(sunny, (64, 32))
    spec = {**TECHNIQUE, "roughness": [0.5]}
    size = (16, 8)

    quick, exact = run(spec, size, image), run({**spec, "method": "sum"}, size, image)
    error = run({**spec, "show": "error"}, size, image)

    difference = np.abs(quick.image.pixels - exact.image.pixels)
    np.testing.assert_allclose(error.image.pixels, difference, atol=1e-6)
    mean = exact.image.pixels.mean()
    assert 0 < quick.report["panels"][0]["error_rms"] < 0.03
    assert difference.max() < 0.1 * mean + 0.02 * exact.image.pixels.max()


def test_a_chain_is_its_pictures_on_each_other():
    image = picture(sunny, (64, 32))
    chain = run({**TECHNIQUE, "roughness": [0.4, 0.8]}, (32, 32), image).image.pixels

    upper = run({**TECHNIQUE, "roughness": [0.4]}, (32, 16), image).image.pixels
    lower = run({**TECHNIQUE, "roughness": [0.8]}, (16, 8), image).image.pixels

    np.testing.assert_array_equal(chain[:16], upper)
    np.testing.assert_allclose(chain[16:24, :16], lower, rtol=2e-2)
    assert not chain[24:].any()
    assert not chain[16:24, 16:].any()


def test_what_is_no_number_is_mended_and_does_not_spread():
    image = picture(lambda d: 1 + 0 * d[:, 0], (32, 16), fine=1)
    pixels = image.pixels.copy()
    pixels[3, 4], pixels[8, 9, 1], pixels[9, 9, 2] = np.nan, np.inf, -np.inf

    made = run({**TECHNIQUE, "roughness": [0.3, 0.9]}, (16, 16), Image(pixels, "colour"))

    assert made.report["mended_numbers"] == 5
    assert np.isfinite(made.image.pixels).all()
    # three dark numbers and one missing direction out of 512
    assert made.image.pixels[:8].min() > 0.5
    assert made.image.pixels.max() <= 1 + 1e-3


def test_the_picture_lies_as_its_layout_says():
    bright = np.array([0.0, 0.6, -0.8])
    image = picture(lambda d: 100.0 * (d @ bright > 0.95), (128, 64))
    cube = {"technique": "cube", "orientation": "gl"}
    size = (16, 96)

    shown = run({**TECHNIQUE, "roughness": [0.3], "to": cube}, size, image).image.pixels[..., 0]

    towards = directions(cube, size)
    brightest = towards[np.unravel_index(shown.argmax(), shown.shape)]
    assert brightest @ bright > 0.99
