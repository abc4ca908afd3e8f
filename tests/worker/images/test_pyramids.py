import math
from fractions import Fraction

import numpy as np
import pytest

from worker.images.pyramids import mip_chain


def test_a_256_square_has_nine_levels_of_87381_texels() -> None:  # T41
    levels = mip_chain(np.zeros((256, 256, 1), np.float32))

    assert len(levels) == 9
    assert sum(level.shape[0] * level.shape[1] for level in levels) == 87381


def test_every_level_of_a_one_texel_checker_is_one_half() -> None:  # T41
    checker = (np.indices((256, 256)).sum(0) % 2).astype(np.float32)[..., None]

    for level in mip_chain(checker)[1:]:
        assert (level == 0.5).all()


@pytest.mark.parametrize(
    "size",
    [(1, 1), (1, 7), (7, 1), (2, 3), (3, 3), (5, 8), (6, 7), (1, 999), (511, 3), (517, 517)],
)
def test_the_mean_is_kept_on_every_level_of_any_size(size: tuple[int, int]) -> None:
    pixels = np.random.default_rng(3).random((*size, 3), np.float32)
    pixels[..., 1] *= 1000
    mean = pixels.mean((0, 1), dtype=np.float64)

    for level in mip_chain(pixels):
        # Each level rounds a handful of times (6e-8 each), at random, over few levels.
        assert level.mean((0, 1), dtype=np.float64) == pytest.approx(mean, rel=1e-6)


@pytest.mark.parametrize("size", [(1, 1), (7, 1), (1, 64), (12, 5), (640, 360)])
def test_sides_halve_downwards_to_one_texel(size: tuple[int, int]) -> None:
    levels = mip_chain(np.zeros((*size, 2), np.float32))

    assert len(levels) == math.floor(math.log2(max(size))) + 1
    for n, level in enumerate(levels):
        assert level.shape == (max(1, size[0] >> n), max(1, size[1] >> n), 2)


def test_odd_sides_weigh_texels_by_the_area_they_share() -> None:
    row = np.array([1, 2, 4, 8, 16], np.float32)[None, :, None]

    level = mip_chain(row)[1]

    # Two texels cover 5/2 each: 1 + 1 + 1/2 and 1/2 + 1 + 1.
    left = (Fraction(1) + 2 + Fraction(4, 2)) / Fraction(5, 2)
    right = (Fraction(4, 2) + 8 + 16) / Fraction(5, 2)
    assert level[0, :, 0] == pytest.approx([float(left), float(right)], rel=1e-6)


def test_rows_and_columns_are_treated_alike() -> None:
    pixels = np.random.default_rng(5).random((9, 14, 4), np.float32)

    upright = mip_chain(pixels)
    lying = mip_chain(np.ascontiguousarray(pixels.transpose(1, 0, 2)))

    for one, other in zip(upright, lying, strict=True):
        assert one == pytest.approx(other.transpose(1, 0, 2), rel=1e-6)


def test_the_first_level_is_the_picture_itself_untouched() -> None:
    pixels = np.random.default_rng(5).random((8, 8, 4), np.float32)
    before = pixels.copy()

    levels = mip_chain(pixels)

    assert levels[0] is pixels
    assert np.array_equal(pixels, before)
