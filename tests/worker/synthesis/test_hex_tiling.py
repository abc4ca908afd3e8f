"""Pieces blended sharply: X09's hex tiling."""

import numpy as np
import pytest
from scipy import ndimage

from tests.growing import colours, noise
from tests.growing import grow as grow_by
from worker.synthesis.by_example.triangles import corners
from worker.synthesis.hex_tiling import blending


def grow(exemplar, size, **fields):
    return grow_by("hex_tiling", exemplar, size, **fields).image.pixels


def test_the_weights_of_the_published_shader():
    # Mikkelsen (2022), listing of hex2colTex: W = lerp(1, Dw, 0.6) * pow(w, 7), then normalised
    weights = np.array([0.5, 0.3, 0.2])
    light = np.array([0.2, 0.9, 0.4])

    found = blending(weights, light, 7, 0.6)

    expected = np.array([0.52 * 0.0078125, 0.94 * 0.0002187, 0.64 * 0.0000128])
    assert found == pytest.approx(expected, rel=1e-12)


@pytest.mark.parametrize("size", [(40, 60), (1, 1), (7, 90)])
def test_weights_are_barycentric(size):
    found, count = corners(size, 12)

    weights = np.stack([corner.weight for corner in found])
    assert weights.sum(axis=0) == pytest.approx(1, abs=1e-12)
    assert weights.min() >= -1e-12
    assert max(int(corner.number.max()) for corner in found) < count


def test_weights_change_little_from_pixel_to_pixel_also_around_the_edges():
    found, count = corners((40, 60), 12)

    fields = np.zeros((count, 40 * 60))
    for corner in found:
        np.add.at(fields, (corner.number, np.arange(40 * 60)), corner.weight)

    # Corners are 40 / 3 and 12 pixels apart: per pixel a weight changes by 1 / 12 at most
    for axis in (1, 2):
        shaped = fields.reshape(count, 40, 60)
        assert np.abs(np.roll(shaped, 1, axis) - shaped).max() <= 1 / 12 + 1e-9


def test_a_very_sharp_blend_is_the_exemplars_own_pixels():
    exemplar = noise(64, 64)

    pixels = grow(exemplar, (32, 32), piece=16, sharpness=64, contrast=0)

    known = colours(exemplar)
    copied = np.mean([pixel.tobytes() in known for pixel in pixels.reshape(-1, 3)])
    # Of the area, that within which the second weight, to the 64th, is below 2^-25
    assert copied > 0.3
    nearest = np.abs(pixels[:, :, None] - exemplar.reshape(-1, 3)[None, None]).max(-1).min(-1)
    assert np.median(nearest) < 1e-3


@pytest.mark.parametrize("rotation", [0, 1])
def test_what_is_alike_in_all_directions_keeps_its_mean(rotation):
    exemplar = ndimage.gaussian_filter(noise(128, 128, 1), (1, 1, 0), mode="wrap")

    pixels = grow(exemplar, (128, 128), piece=16, rotation=rotation, contrast=0)

    # About 60 pieces of means that differ by far less than a pixel does
    assert pixels.mean() == pytest.approx(exemplar.mean(), abs=float(exemplar.std()) / 4)


def test_pieces_are_turned():
    stripes = np.tile((np.arange(96) // 4 % 2)[:, np.newaxis, np.newaxis], (1, 96, 1))

    straight, turned = (grow(stripes, (96, 96), piece=20, rotation=r) for r in (0, 1))

    # Along a stripe nothing changes but where pieces meet; turned ones change in all directions
    along = [np.abs(np.diff(pixels, axis=1)).mean() for pixels in (straight, turned)]
    assert along[0] < 0.06
    assert along[1] > 2 * along[0]


def test_turned_pieces_keep_their_size():
    rows, columns = np.indices((96, 96)) / 96
    places = np.stack([rows, columns, np.zeros((96, 96))], axis=-1)

    pixels = grow(places, (96, 96), piece=24, rotation=1, sharpness=64, contrast=0) * 96

    # A step of one pixel is one in the exemplar, to whichever side, but where pieces meet; and a
    # step down stands upright on one to the right
    right, down = np.diff(pixels, axis=1)[:-1, :, :2], np.diff(pixels, axis=0)[:, :-1, :2]
    for step in (right, down):
        assert np.median(np.hypot(*step.T)) == pytest.approx(1, abs=1e-3)
    assert np.median(np.abs((right * down).sum(axis=-1))) < 1e-3
    assert len(np.unique(np.rint(np.arctan2(*right.T) * 4))) > 6


def test_what_is_light_wins():
    exemplar = (noise(64, 64, 1) > 0.5).astype(np.float32)

    even, lit = (grow(exemplar, (80, 80), piece=8, contrast=c).mean() for c in (0, 1))

    assert lit > even + 0.05


@pytest.mark.parametrize("rotation", [0, 0.7])
def test_it_goes_on_around_its_edges(rotation):
    exemplar = ndimage.gaussian_filter(noise(96, 96, 1), (4, 4, 0))

    pixels = grow(exemplar, (90, 70), piece=20, rotation=rotation)[..., 0]

    steps = np.abs(np.diff(np.pad(pixels, ((0, 1), (0, 1)), mode="wrap"), axis=0)).mean(axis=1)
    assert steps[-1] <= steps[:-1].max() * 1.2


@pytest.mark.parametrize("rotation", [0, 1])
@pytest.mark.parametrize("shape", [(1, 1), (2, 5), (40, 30)])
@pytest.mark.parametrize("size", [(1, 1), (20, 33)])
def test_any_size_stays_within_the_exemplars_range(shape, size, rotation):
    exemplar = noise(*shape) * 7

    pixels = grow(exemplar, size, rotation=rotation)

    assert pixels.shape == (size[1], size[0], 3)
    assert (pixels >= exemplar.min(axis=(0, 1))).all()
    assert (pixels <= exemplar.max(axis=(0, 1))).all()


def test_a_constant_stays_constant():
    assert grow(np.full((30, 30, 3), 0.25), (40, 20), rotation=1) == pytest.approx(0.25, abs=1e-7)


@pytest.mark.parametrize("rotation", [0, 1])
def test_what_has_no_alpha_is_never_blended(rotation):
    exemplar = np.concatenate([noise(60, 60), np.ones((60, 60, 1), np.float32)], axis=-1)
    exemplar[0:9, :] = 0

    pixels = grow(exemplar, (30, 30), piece=8, rotation=rotation)

    assert pixels[..., 3] == pytest.approx(1, abs=1e-6)


def test_infinite_light_stays_finite_as_the_largest_there_is():
    exemplar = noise(40, 40)
    exemplar[10:14, 10:14] = np.inf
    exemplar[20, 20] = np.nan

    assert np.isfinite(grow(exemplar, (60, 60), piece=12, rotation=0.5)).all()


def test_another_map_is_blended_from_the_same_places_by_the_same_weights():
    exemplar = noise(64, 64)

    colour = grow(exemplar, (50, 50), piece=12, rotation=0.5)
    double = grow(exemplar, (50, 50), piece=12, rotation=0.5, picture=exemplar * 2)

    assert double == pytest.approx(2 * colour, rel=1e-6)
