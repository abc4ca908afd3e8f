"""Efros and Leung's growing: T53."""

import numpy as np
import pytest

from tests.growing import colours, noise, sources
from tests.growing import grow as grow_by
from worker.images.image import Image
from worker.synthesis.by_example.exemplar import Exemplar


def grow(exemplar, size, **fields):
    return grow_by("efros_leung", exemplar, size, **fields)


def lines_of_three(times):
    """Rows and columns of a sequence in which three in a row tell the place, and two do not.

    Its period is 7. A window of 7 reaches three pixels: beside the 3 x 3 pixels one begins with,
    and beside all that grows from them, it knows three rows and columns, so one place alone fits.
    """
    line = np.tile([0, 0, 0, 1, 0, 1, 1], times)
    return ((2 * line[:, np.newaxis] + line) / 3)[..., np.newaxis].astype(np.float32)


@pytest.mark.parametrize("shape", [(16, 16), (1, 1), (2, 5), (12, 19)])
@pytest.mark.parametrize("size", [(20, 15), (1, 1), (2, 9)])
def test_every_pixel_is_one_of_the_exemplars_at_the_place_it_says(shape, size):
    exemplar = noise(*shape)

    made = grow(exemplar, size, window=7)

    assert made.image.pixels.tobytes() == exemplar[sources(made, exemplar)].tobytes()


@pytest.mark.parametrize("seed", range(4))
@pytest.mark.parametrize("window", [7, 8, 11])
def test_a_periodic_source_goes_on_exactly(seed, window):
    pixels = grow(lines_of_three(4), (33, 27), window=window, seed=seed).image.pixels

    assert (pixels[7:] == pixels[:-7]).all()
    assert (pixels[:, 7:] == pixels[:, :-7]).all()
    assert len(colours(pixels)) == 4


@pytest.mark.parametrize("seed", range(4))
@pytest.mark.parametrize("window", [3, 5, 6])
def test_it_loses_a_period_that_is_larger_than_the_window(seed, window):
    pixels = grow(lines_of_three(4), (33, 27), window=window, seed=seed).image.pixels

    assert (pixels[7:] != pixels[:-7]).any()


def test_a_hole_in_a_periodic_picture_is_filled_exactly():
    whole = lines_of_three(5)
    mask = np.ones((35, 35, 1), np.float32)
    mask[10:20, 12:25] = 0
    broken = whole * mask

    pixels = grow(whole, (35, 35), window=7, keep=broken, keep_mask=mask).image.pixels

    assert pixels.tobytes() == whole.tobytes()


def test_a_constant_stays_constant():
    assert (grow(np.full((9, 9, 3), 0.25), (20, 20)).image.pixels == np.float32(0.25)).all()


def test_what_has_no_alpha_is_never_copied():
    exemplar = np.concatenate([noise(20, 20), np.ones((20, 20, 1), np.float32)], axis=-1)
    exemplar[8:10, :14] = 0

    assert (grow(exemplar, (24, 24), window=5).image.pixels[..., 3] == 1).all()


def test_it_can_go_on_around_its_edges():
    pixels = grow(lines_of_three(4), (35, 28), window=7, tileable=True).image.pixels

    assert (np.roll(pixels, 7, axis=0) == pixels).all()
    assert (np.roll(pixels, 7, axis=1) == pixels).all()


def test_a_pixel_is_within_a_tenth_of_the_nearest():
    """The last of a picture, by brute force: all but one pixel is kept."""
    exemplar, keep = noise(14, 14, seed=1), noise(11, 11, seed=2)
    mask = np.ones((11, 11, 1), np.float32)
    mask[5, 5] = 0

    made = grow(exemplar, (11, 11), window=5, keep=keep, keep_mask=mask)

    space = Exemplar.of({"exemplar": Image(exemplar, "colour")})
    ours, theirs = space.features.astype(int), space.matching(Image(keep, "colour")).astype(int)
    steps = np.exp(-0.5 * (np.arange(-2, 3) / (5 / 6.4)) ** 2)
    weights = np.outer(steps, steps)[..., np.newaxis]
    weights[2, 2] = 0
    around = theirs[3:8, 3:8]
    found = {
        (v, u): (weights * (ours[v - 2 : v + 3, u - 2 : u + 3] - around) ** 2).sum()
        for v in range(2, 12)
        for u in range(2, 12)
    }
    rows, columns = sources(made, exemplar)
    # Whole weights out of 8192 are off by a half each
    assert found[rows[5, 5], columns[5, 5]] <= 1.1 * min(found.values()) * 1.01
