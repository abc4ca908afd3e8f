"""Holes that are filled, and parts that are moved: T60."""

import numpy as np
import pytest

from tests.growing import colours, grow, noise
from worker.errors import RenderError


def hole(height, width, rows, columns):
    mask = np.zeros((height, width, 1), np.float32)
    mask[rows, columns] = 1
    return mask


def fill(whole, mask, **fields):
    return grow("hole_filling", whole, whole.shape[1::-1], hole=mask, **fields)


def shuffle(picture, region, shift, **fields):
    height, width = picture.shape[:2]
    return grow("image_shuffling", picture, (width, height), region=region, shift=shift, **fields)


@pytest.mark.parametrize("seed", range(3))
@pytest.mark.parametrize("period", [(4, 5), (8, 8)])
def test_a_hole_in_a_periodic_texture_is_restored_exactly(seed, period):
    rows, columns = period
    tile = np.random.default_rng(seed).random((rows, columns, 3), np.float32)
    whole = np.tile(tile, (12, 12, 1))
    mask = hole(*whole.shape[:2], np.s_[20:32], np.s_[18:35])
    broken = np.where(mask > 0, np.float32(0.5), whole)

    pixels = fill(broken, mask, seed=seed).image.pixels

    assert pixels.tobytes() == whole.tobytes()


def test_what_is_outside_stays_and_what_is_inside_comes_from_there():
    picture = noise(40, 50)
    mask = hole(40, 50, np.s_[10:22], np.s_[30:50])

    pixels = fill(picture, mask).image.pixels

    inside = mask[..., 0] > 0
    assert pixels[~inside].tobytes() == picture[~inside].tobytes()
    assert colours(pixels[inside]) <= colours(picture[~inside])


def test_a_hole_begins_at_one_half():
    picture, grey = noise(20, 30), np.full((20, 30, 1), 0.49, np.float32)
    grey[6:10, 8:14] = 0.5

    exact = fill(picture, (grey >= 0.5).astype(np.float32)).image.pixels
    region = shuffle(picture, (grey >= 0.5).astype(np.float32), [9, 4]).image.pixels

    assert fill(picture, grey).image.pixels.tobytes() == exact.tobytes()
    assert (exact[6:10, 8:14] != picture[6:10, 8:14]).any(axis=-1).all()
    assert shuffle(picture, grey, [9, 4]).image.pixels.tobytes() == region.tobytes()
    assert region[10:14, 17:23].tobytes() == picture[6:10, 8:14].tobytes()


def test_without_a_hole_nothing_changes():
    picture = noise(20, 30)

    made = fill(picture, np.zeros((20, 30, 1), np.float32))

    assert made.image.pixels.tobytes() == picture.tobytes()
    assert made.report["quality"]["coherent"] > 0.99


def test_a_hole_that_is_everything_is_refused():
    with pytest.raises(RenderError) as caught:
        fill(noise(20, 30), np.ones((20, 30, 1), np.float32))

    assert caught.value.code == "exemplar_unusable"


def test_other_maps_of_a_material_are_filled_from_the_same_places():
    picture = noise(30, 30)
    mask = hole(30, 30, np.s_[10:16], np.s_[10:20])
    rows, columns = np.indices((30, 30), np.float32)
    places = np.stack([rows, columns, rows * 0], axis=-1)

    colour = fill(picture, mask).image.pixels
    where = fill(picture, mask, picture=places).image.pixels.astype(int)

    assert colour.tobytes() == picture[where[..., 0], where[..., 1]].tobytes()


def test_a_region_arrives_bit_for_bit_and_is_gone_from_where_it_was():
    picture = noise(48, 64) * 0.5
    region = hole(48, 64, np.s_[10:20], np.s_[8:20])
    picture[region[..., 0] > 0] += 0.5

    pixels = shuffle(picture, region, [30, 15], margin=3).image.pixels

    moved = picture[10:20, 8:20]
    assert pixels[25:35, 38:50].tobytes() == moved.tobytes()
    assert not colours(pixels[10:20, 8:20]) & colours(moved)
    far = np.ones((48, 64), bool)
    far[7:23, 5:23] = far[22:38, 35:53] = False
    assert pixels[far].tobytes() == picture[far].tobytes()


def test_a_region_in_a_corner_leaves_the_others_alone():
    picture = noise(40, 40)
    region = hole(40, 40, np.s_[:8], np.s_[:8])

    pixels = shuffle(picture, region, [20, 12], margin=0).image.pixels

    assert pixels[12:20, 20:28].tobytes() == picture[:8, :8].tobytes()
    stays = region[..., 0] == 0
    stays[12:20, 20:28] = False
    assert pixels[stays].tobytes() == picture[stays].tobytes()


def test_the_margin_is_made_anew_and_no_more():
    picture = noise(48, 64)
    region = hole(48, 64, np.s_[10:20], np.s_[8:20])

    made = {margin: shuffle(picture, region, [30, 15], margin=margin) for margin in (0, 4)}

    changed = {margin: (each.image.pixels != picture).any(-1) for margin, each in made.items()}
    touched = np.zeros((48, 64), bool)
    touched[10:20, 8:20] = touched[25:35, 38:50] = True
    ring = np.zeros((48, 64), bool)
    ring[6:24, 4:24] = ring[21:39, 34:54] = True
    assert (changed[0] == touched).all()
    assert not changed[4][~ring].any()
    # Part of what is made anew finds what was there
    assert changed[4][ring & ~touched].mean() > 0.25


@pytest.mark.parametrize("shift", [[0, 0], [3, 2]])
def test_moving_nothing_or_nowhere_changes_nothing(shift):
    picture = noise(20, 20)
    region = hole(20, 20, np.s_[5:9], np.s_[5:9]) * (shift == [0, 0])

    assert shuffle(picture, region, shift).image.pixels.tobytes() == picture.tobytes()


def test_a_region_moved_outside_is_gone():
    picture = noise(40, 40) * 0.5
    region = hole(40, 40, np.s_[10:20], np.s_[8:20])
    picture[region[..., 0] > 0] += 0.5

    pixels = shuffle(picture, region, [500, 0]).image.pixels

    assert pixels.max() < 0.5
