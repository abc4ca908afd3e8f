"""How good a result is, told in numbers: of coordinate maps whose figures are known."""

import numpy as np
import pytest

from tests.growing import noise
from worker.images.image import Image
from worker.synthesis.by_example.exemplar import Exemplar
from worker.synthesis.by_example.filling import unmoved
from worker.synthesis.by_example.quality import patch_distance, quality, repetition, seam


def judged(place, exemplar=None):
    exemplar = noise(40, 48) if exemplar is None else exemplar
    return quality(place, Exemplar.of({"exemplar": Image(exemplar, "colour")}))


def features(lines):
    return np.asarray(lines, np.uint8)[..., np.newaxis]


@pytest.mark.parametrize("turned", [False, True])
def test_a_seam_is_the_step_across_the_border_beside_the_largest_inside(turned):
    # 0, 10, .. 70: steps of 10 inside, of 70 from the last to the first
    slope = features(np.tile(np.arange(8) * 10, (6, 1)))

    assert seam(slope.swapaxes(0, 1) if turned else slope) == pytest.approx(7)


def test_a_seam_like_the_sharpest_edge_inside_is_not_seen():
    assert seam(features(np.tile([30, 30, 30, 30, 0, 0, 0], (6, 1)))) == pytest.approx(1)


def test_what_tiles_has_no_seam_and_what_is_flat_none_either():
    waves = features(np.tile([0, 10, 20, 10], (6, 3)))

    assert seam(waves) == pytest.approx(1)
    assert seam(features(np.full((5, 5), 9))) == 0


def test_the_exemplar_itself_is_one_piece_copied_whole():
    told = judged(unmoved((40, 48)))

    assert told["pieces"] == 1
    assert told["verbatim"] == 1
    assert told["longest_run"] == 48
    # All but the first of 1920 pixels continue another one
    assert told["coherent"] == round(1919 / 1920, 4)
    assert {told[f"{way}_exemplar_2"] for way in ("to", "from")} == {0}


def test_two_halves_that_do_not_fit_are_two_pieces():
    place = unmoved((40, 48))
    place[:, 25:] -= (0, 20)

    told = judged(place)

    assert told["pieces"] == 2
    assert told["longest_run"] == 40  # down the columns, which are whole; across it is 25
    assert told["coherent"] == round(1918 / 1920, 4)
    assert told["verbatim"] == 1


def test_pixels_that_continue_nothing_are_pieces_of_their_own():
    # Mirrored, each pixel goes on to the wrong side: columns are lines still, which no window holds
    told = judged(unmoved((40, 48))[:, ::-1])

    assert told["pieces"] == 48
    assert told["longest_run"] == 40
    assert told["verbatim"] == 0
    assert told["coherent"] == round(39 / 40, 4)


def test_a_window_of_8_x_8_is_the_least_that_counts_as_verbatim():
    place = unmoved((40, 48))[::-1, ::-1].copy()
    place[4:12, 10:18] = unmoved((40, 48))[4:12, 10:18]

    assert judged(place)["verbatim"] == round(64 / 1920, 4)


def test_kept_pixels_count_for_nothing():
    place = unmoved((40, 48))
    place[:, 20:] = -1

    told = judged(place)

    assert told["coherent"] == round(799 / 800, 4)
    assert (told["longest_run"], told["pieces"]) == (40, 1)


def test_what_repeats_is_found_and_noise_does_not():
    tile = (noise(16, 16, 1) * 255).astype(np.uint8)

    assert repetition(np.tile(tile, (3, 3, 1))) == pytest.approx(1)
    # Of 48 x 48 numbers, any correlation beyond five deviations (5 / 48) is no chance
    assert repetition((noise(48, 48, 1) * 255).astype(np.uint8)) < 5 / 48
    assert repetition(np.full((16, 16, 1), 7, np.uint8)) == 0


def test_patches_a_fifth_of_white_away_are_a_fifth_away():
    black, grey = np.zeros((24, 24, 3), np.uint8), np.full((30, 30, 3), 51, np.uint8)
    everywhere = [np.ones(picture.shape[:2], bool) for picture in (black, grey)]

    assert patch_distance(black, everywhere[0], grey, everywhere[1]) == pytest.approx(0.2)


def test_distances_are_told_both_ways():
    # The result is the left half: all of it is in the exemplar, but not the other way round
    exemplar = noise(40, 80)
    exemplar[:, 40:] *= 0.1

    told = judged(unmoved((40, 40)), exemplar)

    assert told["to_exemplar_2"] < 0.05 * told["from_exemplar_2"]


def test_what_is_too_small_for_patches_has_no_distance():
    told = judged(unmoved((40, 48)))

    # 5 x 6 pixels at an eighth
    assert told["to_exemplar_8"] is None
