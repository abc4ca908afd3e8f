import math
from fractions import Fraction

import numpy as np
import pytest

from worker.images.pyramids import Cut, keep_coverage, mip_chain


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


@pytest.mark.parametrize("share", [0.0, 0.01, 0.3, 0.7, 0.99, 1.0])
@pytest.mark.parametrize(("scale", "bias"), [(1.0, 0.0), (-1.0, 1.0), (0.5, 0.25)])
def test_holes_keep_their_share_on_every_level(share: float, scale: float, bias: float) -> None:
    opacity = np.where(np.random.default_rng(8).random((128, 96)) < share, 0.75, 0.25)
    stored = np.zeros((128, 96, 3), np.float32)
    stored[..., 1] = (opacity - bias) / scale
    levels = mip_chain(stored)
    before = [level.copy() for level in levels]

    keep_coverage(levels, Cut(channel=1, scale=scale, bias=bias, cutoff=0.6))

    exact = np.mean(levels[0][..., 1] * scale + bias >= 0.6)
    for level, old in zip(levels[:5], before, strict=False):
        shown = np.mean(level[..., 1] * scale + bias >= 0.6)
        # Equal texels go together: half of the largest group of them is the most one can be wrong.
        group = np.unique(old[..., 1], return_counts=True)[1].max() / old[..., 1].size
        assert abs(shown - exact) <= group / 2 + 1e-9
        np.testing.assert_array_equal(level[..., [0, 2]], old[..., [0, 2]])
    np.testing.assert_array_equal(levels[0], before[0])


def test_a_level_with_the_right_holes_is_left_alone() -> None:
    halves = np.repeat([[0.0], [1.0]], 32, axis=0).astype(np.float32)
    levels = mip_chain(np.repeat(halves, 64, axis=1)[..., None])

    before = [level.copy() for level in levels]
    keep_coverage(levels, Cut(channel=0, scale=1.0, bias=0.0, cutoff=0.5))

    for level, old in zip(levels[:-1], before[:-1], strict=True):
        np.testing.assert_array_equal(level, old)


@pytest.mark.parametrize(
    "cut",
    [
        Cut(3, 1.0, 0.0, 0.5),
        Cut(0, 0.0, 1.0, 0.5),
        Cut(0, 1.0, 0.0, 0.0),
    ],
    ids=["no such channel", "no scale", "nothing is a hole"],
)
def test_where_no_texel_decides_nothing_changes(cut: Cut) -> None:
    levels = mip_chain(np.random.default_rng(1).random((8, 8, 1), np.float32))
    before = [level.copy() for level in levels]

    keep_coverage(levels, cut)

    for level, old in zip(levels, before, strict=True):
        np.testing.assert_array_equal(level, old)


@pytest.mark.parametrize("value", [np.nan, np.inf, -np.inf, 3e38, 0.0])
def test_any_number_may_be_opacity(value: float) -> None:
    pixels = np.full((8, 8, 1), value, np.float32)
    with np.errstate(invalid="ignore", over="ignore"):
        levels = mip_chain(pixels)
        keep_coverage(levels, Cut(0, 1.0, 0.0, 0.5))

    assert all(level.dtype == np.float32 for level in levels)
