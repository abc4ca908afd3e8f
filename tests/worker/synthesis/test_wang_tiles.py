"""X14: tiles whose edges agree, all of them used, in an order without a period."""

import numpy as np
import pytest
from pydantic import TypeAdapter

from api_schemas.members import Texture
from worker.images.image import Image
from worker.synthesis import outcome
from worker.synthesis._seams import least_seam
from worker.synthesis.wang_tiles import numbers_of, tile_set

ASSET = {"technique": "image", "asset": "0" * 64}
NOISE = np.random.default_rng(0).random((60, 50, 3)).astype(np.float32)


def laid(exemplar, size, **fields):
    height, width = exemplar.shape[:2]
    body = {
        "technique": "wang_tiles",
        "input": ASSET,
        "exemplar_size": [width, height],
        "half_side": 8,
        **fields,
    }
    spec = TypeAdapter(Texture).validate_python(body)
    return outcome(spec, size, lambda *_: Image(exemplar, "colour"))


def test_x14_all_adjacent_edges_agree_around_the_rim_too():
    numbers = numbers_of(20, 30, 4)

    assert (numbers >> 2 & 1 == np.roll(numbers, -1, 1) & 1).all()
    assert (numbers >> 1 & 1 == np.roll(numbers, -1, 0) >> 3 & 1).all()


def test_x14_all_tiles_are_used_and_no_shift_repeats_them():
    numbers = numbers_of(32, 32, 1)

    shares = np.bincount(numbers.ravel(), minlength=16) / 1024
    # Each 1/16 of 1024, +- 7.7
    assert shares == pytest.approx(1 / 16, abs=4 * 0.0076)
    same = [
        (numbers == np.roll(numbers, (down, across), (0, 1))).mean()
        for down, across in np.ndindex(32, 32)
        if (down, across) != (0, 0)
    ]
    assert max(same) < 0.15


def test_x14_across_an_edge_the_exemplar_goes_on():
    tiles, _ = tile_set(NOISE, 8, 3)
    lookup = {
        NOISE[row, column].tobytes(): (row, column) for row, column in np.ndindex(NOISE.shape[:2])
    }

    for left, right in np.ndindex(16, 16):
        if left >> 2 & 1 != right & 1:
            continue
        for row in range(1, 15):
            here = lookup[tiles[left, row, 15].tobytes()]
            there = lookup[tiles[right, row, 0].tobytes()]
            assert there == (here[0], here[1] + 1)
    for upper, lower in np.ndindex(16, 16):
        if upper >> 1 & 1 == lower >> 3 & 1:
            here = lookup[tiles[upper, 15, 7].tobytes()]
            assert lookup[tiles[lower, 0, 7].tobytes()] == (here[0] + 1, here[1])


def test_every_pixel_is_one_of_the_exemplar_and_tiles_lie_where_their_layer_says():
    made = laid(NOISE, (64, 48), tiles=[4, 3], seed=5)

    known = {texel.tobytes() for texel in NOISE.reshape(-1, 3)}
    assert {texel.tobytes() for texel in made.image.pixels.reshape(-1, 3)} <= known
    tiles, _ = tile_set(NOISE, 8, 5)
    layer = made.layers["tile"].pixels[..., 0]
    for row, column in np.ndindex(3, 4):
        place = np.s_[16 * row : 16 * row + 16, 16 * column : 16 * column + 16]
        number = int(layer[place][0, 0])
        assert (layer[place] == number).all()
        assert made.image.pixels[place].tobytes() == tiles[number].tobytes()
    assert made.report["tiles_used"] == len(np.unique(layer))


def test_an_even_exemplar_gives_an_even_picture_and_no_seams():
    made = laid(np.full((16, 16, 3), 0.25, np.float32), (40, 40), tiles=[2, 2])

    assert (made.image.pixels == 0.25).all()
    assert made.report["seam_error"] == 0


def test_a_seam_runs_where_the_pictures_agree():
    apart = np.ones((9, 9))
    path = [(0, 0), (1, 1), (2, 1), (3, 2), (4, 3), (5, 4), (6, 6), (7, 7), (8, 8)]
    for place in [*path, (5, 5)]:
        apart[place] = 0

    mask, cost = least_seam(apart)

    assert cost == 0
    for row in range(9):
        left = max(column for y, column in [*path, (5, 5)] if y == row)
        assert mask[row].tolist() == [False] * (left + 1) + [True] * (8 - left)


def test_a_seam_never_reaches_the_sides():
    mask, _ = least_seam(np.random.default_rng(2).random((16, 16)))

    assert mask[0, 1:].all()
    assert not mask[1:, 0].any()


def test_an_exemplar_smaller_than_a_tile_goes_on_around_its_edges():
    made = laid(NOISE[:16, :16], (64, 64), half_side=16, tiles=[2, 2])

    assert made.image.pixels.shape == (64, 64, 3)
    assert np.isfinite(made.image.pixels).all()
