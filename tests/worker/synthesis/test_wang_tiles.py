"""X14: tiles whose edges agree, all of them used, in an order without a period."""

import itertools

import numpy as np
import pytest
from pydantic import TypeAdapter
from scipy import ndimage

from api_schemas.members import Texture
from tests.growing import colours, sources
from worker.errors import RenderError
from worker.images.image import Image
from worker.synthesis import outcome
from worker.synthesis.by_example.exemplar import Exemplar
from worker.synthesis.by_example.quality import repetition
from worker.synthesis.by_example.tile_set import TileSet
from worker.synthesis.wang_tiles import corners_of, numbers_of

ASSET = {"technique": "image", "asset": "0" * 64}
NOISE = np.random.default_rng(0).random((60, 50, 3)).astype(np.float32)


def wang(**fields):
    body = {"technique": "wang_tiles", "input": ASSET, "half_side": 8, **fields}
    return TypeAdapter(Texture).validate_python(body)


def laid(exemplar, size, **fields):
    height, width = exemplar.shape[:2]
    spec = wang(exemplar_size=[width, height], **fields)
    return outcome(spec, size, lambda *_: Image(exemplar, "colour"))


def soft(side, seed=3):
    """Noise without sharp steps, so that a seam would be seen."""
    random = np.random.default_rng(seed).random((side, side, 3))
    pixels = ndimage.gaussian_filter(random, (2, 2, 0), mode="wrap")
    return ((pixels - pixels.min()) / np.ptp(pixels)).astype(np.float32)


def test_x14_all_adjacent_corners_agree_around_the_rim_too():
    spec = wang(kinds=3, variants=2, seed=4)
    numbers = numbers_of(20, 30, spec)

    for row, column in np.ndindex(20, 30):
        _, upper_right, lower_right, lower_left = corners_of(int(numbers[row, column]), spec)
        right = corners_of(int(numbers[row, (column + 1) % 30]), spec)
        below = corners_of(int(numbers[(row + 1) % 20, column]), spec)
        assert (upper_right, lower_right) == (right.upper_left, right.lower_left)
        assert (lower_left, lower_right) == (below.upper_left, below.upper_right)


@pytest.mark.parametrize(("kinds", "variants"), [(2, 1), (3, 1), (2, 5)])
def test_x14_all_tiles_are_used_alike_and_no_shift_repeats_them(kinds, variants):
    numbers = numbers_of(64, 64, wang(kinds=kinds, variants=variants, seed=1))

    count = kinds**4 * variants
    shares = np.bincount(numbers.ravel(), minlength=count) / 4096
    # Each 1 / count of 4096, +- 4.5 standard deviations of as many draws, neighbours being related
    assert shares == pytest.approx(1 / count, abs=4.5 * np.sqrt(2 / count / 4096))
    same = [
        (numbers == np.roll(numbers, shift, (0, 1))).mean()
        for shift in itertools.product(range(33), repeat=2)
        if shift != (0, 0)
    ]
    # Shifted by one, two corners of a tile are of its neighbour: 1 / kinds^4 all the same
    assert max(same) < 1 / count + 6 * np.sqrt(2 / count / 4096)


def test_x14_tiles_with_the_same_corners_show_the_same_at_their_edges_and_the_exemplar_goes_on():
    exemplar = Exemplar.of({"exemplar": Image(NOISE, "colour")})
    tiles = TileSet(exemplar, 16, 2, 3)
    every = list(itertools.product(range(2), repeat=4))
    made = {corners: tiles.tile(corners) for corners in every}

    edges, goes_on = {}, []
    for left, right in itertools.product(every, repeat=2):
        if (left[1], left[2]) == (right[0], right[3]):
            here, there = made[left][:, -1], made[right][:, 0]
            goes_on.append((there - here == [0, 0, 1]).all(axis=-1).mean())
            edges.setdefault((0, left[1], left[2]), set()).add((here.tobytes(), there.tobytes()))
    for upper, lower in itertools.product(every, repeat=2):
        if (upper[3], upper[2]) == (lower[0], lower[1]):
            here, there = made[upper][-1], made[lower][0]
            goes_on.append((there - here == [0, 1, 0]).all(axis=-1).mean())
            edges.setdefault((1, upper[3], upper[2]), set()).add((here.tobytes(), there.tobytes()))
    assert len(edges) == 8
    assert all(len(shown) == 1 for shown in edges.values())
    # But where the seam between a corner and the edge crosses, twice in 16 pixels
    assert np.mean(goes_on) > 0.85


def test_x14_the_step_across_borders_of_tiles_is_no_larger_than_inside():
    pixels = laid(soft(64), (384, 320), tiles=[24, 20], seed=2).image.pixels

    for axis in (0, 1):
        steps = np.abs(pixels - np.roll(pixels, 1, axis)).mean(axis=(1 - axis, 2))
        # By where in a tile; at 0 across the border to the one before
        means = steps.reshape(-1, 16).mean(axis=0)
        assert means[0] <= means[1:].max()


def test_x14_less_comes_back_a_whole_number_of_tiles_away_than_of_four_pieces():
    """Were all made of two pieces for each direction, half of all pixels would.

    Here a third of what is at corners does, a quarter of a tile, a ninth of what is at edges, half
    of it, and 1 / 81 of the middle: 0.142 in all. Chance adds, 4 standard deviations of the share
    of 576 corners of one kind: 0.02. A periodic tiling has 1 for both.
    """
    made = laid(NOISE, (384, 384), tiles=[24, 24], seed=5)
    rows, columns = sources(made, NOISE)
    place = rows * 50 + columns

    same = [
        (place == np.roll(place, (16 * down, 16 * across), (0, 1))).mean()
        for down, across in itertools.product(range(13), repeat=2)
        if (down, across) != (0, 0)
    ]
    assert max(same) < 0.142 + 0.02 + 0.04
    # White noise is like itself only where it is the same, but for 1 / sqrt(pixels)
    features = np.rint(made.image.pixels * 255).astype(np.uint8)
    assert repetition(features) < 0.142 + 0.06 + 5 / 384


def test_every_pixel_is_one_of_the_exemplar_and_tiles_lie_where_their_layer_says():
    made = laid(NOISE, (128, 96), tiles=[8, 6], kinds=2, seed=5)

    assert colours(made.image.pixels) <= colours(NOISE)
    assert made.image.pixels.tobytes() == NOISE[sources(made, NOISE)].tobytes()
    layer = made.layers["tile"].pixels[..., 0]
    shown = {}
    for row, column in np.ndindex(6, 8):
        place = np.s_[16 * row : 16 * row + 16, 16 * column : 16 * column + 16]
        number = int(layer[place][0, 0])
        assert (layer[place] == number).all()
        shown.setdefault(number, set()).add(made.image.pixels[place].tobytes())
    assert all(len(tiles) == 1 for tiles in shown.values())
    assert len(set().union(*shown.values())) == len(shown) == made.report["tiles_used"]


def test_variants_have_the_same_rim_and_other_middles():
    exemplar = Exemplar.of({"exemplar": Image(NOISE, "colour")})
    tiles = TileSet(exemplar, 16, 2, 3)

    made = [tiles.tile((0, 1, 1, 0)) for _ in range(4)]

    rim = np.ones((16, 16), bool)
    rim[1:-1, 1:-1] = False
    assert len({spots[rim].tobytes() for spots in made}) == 1
    assert len({spots[4:-4, 4:-4].tobytes() for spots in made}) == 4


def test_an_even_exemplar_gives_an_even_picture():
    made = laid(np.full((16, 16, 3), 0.25, np.float32), (40, 40), tiles=[2, 2])

    assert (made.image.pixels == 0.25).all()


@pytest.mark.parametrize("shape", [(16, 16), (17, 40), (31, 16)])
def test_an_exemplar_smaller_than_a_tile_goes_on_around_its_edges(shape):
    exemplar = NOISE[: shape[0], : shape[1]]

    made = laid(exemplar, (128, 128), half_side=16, tiles=[4, 4])

    assert made.image.pixels.tobytes() == exemplar[sources(made, exemplar)].tobytes()


def test_what_has_no_alpha_is_never_copied_and_without_room_for_a_tile_it_is_refused():
    exemplar = np.concatenate([NOISE, np.ones((60, 50, 1), np.float32)], axis=-1)
    exemplar[20:24, :30] = 0

    assert (laid(exemplar, (64, 64), tiles=[4, 4]).image.pixels[..., 3] == 1).all()
    exemplar[::10] = 0
    with pytest.raises(RenderError, match="no square of 16 x 16") as caught:
        laid(exemplar, (64, 64), tiles=[4, 4])
    assert caught.value.code == "exemplar_unusable"


def test_another_seed_gives_another_picture_and_the_same_one_the_same():
    first, again, other = (laid(NOISE, (64, 64), tiles=[4, 4], seed=seed) for seed in (1, 1, 2))

    assert first.image.pixels.tobytes() == again.image.pixels.tobytes()
    assert first.image.pixels.tobytes() != other.image.pixels.tobytes()
