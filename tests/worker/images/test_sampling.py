"""Pictures read at any place on the CPU: what OpenGL's samplers would read."""

import numpy as np
import pytest

from worker.images.pyramids import mip_chain
from worker.images.sampling import sample

ROW = np.float32([[10, 20, 40]])  # texel centres at 1/6, 1/2, 5/6


def read(u, wrap="repeat", picture=ROW, **how):
    places = np.array([[value, 0.5] for value in np.atleast_1d(u)])
    return sample([picture], places, (wrap, "clamp"), **how)


def test_a_place_between_two_texels_is_their_mixture():
    assert read([1 / 6, 1 / 3, 0.5, 5 / 6]) == pytest.approx([10, 15, 20, 40])


@pytest.mark.parametrize(
    ("wrap", "expected"),
    [("repeat", [25, 25, 10]), ("mirror", [10, 40, 40]), ("clamp", [10, 40, 40])],
)
def test_beyond_the_tile_lies_what_the_wrap_says(wrap, expected):
    assert read([0.0, 1.0, 7 / 6], wrap) == pytest.approx(expected)


def test_mirrored_copies_alternate_and_a_border_is_a_border():
    assert read([2 + 1 / 6, -5 / 6, 1 + 5 / 6], "mirror") == pytest.approx([10, 40, 10])
    assert read([-1 / 6, 0.0, 1.5], "border", border=-6.0) == pytest.approx([-6, 2, -6])


def test_the_nearest_texel_is_the_one_that_covers_the_place():
    found = read([0.0, 0.333, 0.334, 0.999, 1.0], smooth=False)

    assert found.tolist() == [10, 10, 20, 40, 10]


def test_v_is_up():
    picture = np.float32([[1], [2]])

    assert sample([picture], np.array([[0.5, 0.75], [0.5, 0.25]]), ("clamp", "clamp")).tolist() == [
        1,
        2,
    ]


def test_levels_are_blended_by_their_number():
    picture = np.random.default_rng(0).random((8, 8, 1)).astype(np.float32)
    levels = [level[..., 0] for level in mip_chain(picture)]
    place = np.full((6, 2), 0.3)

    found = sample(levels, place, ("repeat", "repeat"), detail=np.array([0, 1, 0.25, 3, 99, -5]))

    first, second = (sample([level], place[:1], ("repeat", "repeat"))[0] for level in levels[:2])
    mean = picture.mean()
    expected = [first, second, 0.75 * first + 0.25 * second, mean, mean, first]
    assert found == pytest.approx(expected, abs=1e-6)


def test_very_far_away_is_still_somewhere():
    assert np.isfinite(read([1e300, -1e300, 1e18])).all()
