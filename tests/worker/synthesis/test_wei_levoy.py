"""Wei and Levoy's neighbourhoods: T54."""

import numpy as np
import pytest
from numpy.lib.stride_tricks import sliding_window_view
from scipy import ndimage

from tests.growing import grow as grow_by
from tests.growing import noise, sources
from worker.images.image import Image
from worker.synthesis.by_example.exemplar import Exemplar


def grow(exemplar, size, **fields):
    return grow_by("wei_levoy", exemplar, size, **fields)


@pytest.mark.parametrize("shape", [(16, 16), (1, 1), (2, 5), (20, 31)])
@pytest.mark.parametrize("size", [(40, 24), (1, 1), (3, 17)])
def test_every_pixel_is_one_of_the_exemplars_at_the_place_it_says(shape, size):
    exemplar = noise(*shape)

    made = grow(exemplar, size)

    assert made.image.pixels.tobytes() == exemplar[sources(made, exemplar)].tobytes()


def test_on_one_level_each_pixel_has_the_nearest_neighbourhood():
    """By brute force, where no edge is seen: what is above and to the left was final."""
    exemplar = noise(13, 12, seed=3)

    made = grow(exemplar, (19, 18), neighbourhood=2, levels=1)

    ours = Exemplar.of({"exemplar": Image(exemplar, "colour")}).features.astype(int)
    rows, columns = sources(made, exemplar)
    target = ours[rows, columns]
    offsets = [(y, x) for y in range(-2, 1) for x in range(-2, 3) if y < 0 or x < 0]
    for y in range(6, 12):
        for x in range(6, 12):

            def cost(v, u, y=y, x=x):
                return sum(
                    ((ours[v + dy, u + dx] - target[y + dy, x + dx]) ** 2).sum()
                    for dy, dx in offsets
                )  # fmt: skip

            least = min(cost(v, u) for v in range(2, 11) for u in range(2, 10))
            assert cost(rows[y, x], columns[y, x]) == least


def test_a_constant_stays_constant():
    assert (grow(np.full((20, 20, 3), 0.25), (30, 20)).image.pixels == np.float32(0.25)).all()


def test_what_has_no_alpha_is_never_copied():
    exemplar = np.concatenate([noise(32, 32), np.ones((32, 32, 1), np.float32)], axis=-1)
    exemplar[8:12, :20] = 0

    assert (grow(exemplar, (40, 40)).image.pixels[..., 3] == 1).all()


def test_it_is_less_coherent_than_pieces():
    """It chooses freely, so it copies shorter runs than Ashikhmin's algorithm does."""
    exemplar = noise(32, 32)

    free = grow(exemplar, (48, 48)).report["quality"]["coherent"]
    pieces = grow_by("ashikhmin", exemplar, (48, 48)).report["quality"]["coherent"]

    assert free < pieces


def test_patches_across_the_edges_are_as_near_to_the_exemplars_as_those_inside():
    exemplar = ndimage.gaussian_filter(noise(48, 48, 1), (2, 2, 0))
    known = sliding_window_view(exemplar[..., 0], (5, 5)).reshape(-1, 25)

    pixels = grow(exemplar, (48, 48), neighbourhood=4).image.pixels[..., 0]

    around = np.pad(pixels, ((0, 4), (0, 4)), mode="wrap")
    windows = sliding_window_view(around, (5, 5)).reshape(-1, 25)
    distances = ((windows[:, np.newaxis] - known) ** 2).sum(axis=-1).min(axis=1).reshape(48, 48)
    across = np.ones((48, 48), bool)
    across[:44, :44] = False
    assert distances[across].mean() <= 2 * distances[~across].mean()
