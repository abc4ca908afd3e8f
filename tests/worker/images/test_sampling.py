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


def linear(shape):
    """A volume of u + 10 v + 100 w at its voxels' centres."""
    depth, height, width = shape
    w, v, u = np.meshgrid(
        (np.arange(depth) + 0.5) / depth,
        1 - (np.arange(height) + 0.5) / height,
        (np.arange(width) + 0.5) / width,
        indexing="ij",
    )
    return (u + 10 * v + 100 * w).astype(np.float32)


def test_a_volume_of_a_linear_function_is_read_exactly():
    # T19: trilinear blending keeps it, away from the edges
    places = np.random.default_rng(1).uniform(0.2, 0.8, (50, 3))

    found = sample([linear((8, 4, 16))], places, ("clamp", "clamp", "clamp"))

    assert found == pytest.approx(places @ [1, 10, 100], abs=1e-4)


def test_the_nearest_voxel_is_the_one_that_covers_the_place():
    volume = linear((2, 2, 2))

    found = sample([volume], np.array([[0.1, 0.9, 0.6]]), ("repeat",) * 3, smooth=False)

    assert found.tolist() == [volume[1, 0, 0]]


def test_a_volume_has_levels_too():
    volume = np.random.default_rng(2).random((4, 4, 4)).astype(np.float32)
    mean = np.full((1, 1, 1), volume.mean(), np.float32)

    found = sample([volume, mean], np.full((1, 3), 0.4), ("repeat",) * 3, detail=np.array([1.0]))

    assert found == pytest.approx(volume.mean())
