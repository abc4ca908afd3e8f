"""The k nearest patches: Barnes et al. (2010), beside T58 and T59."""

import itertools

import numpy as np
import pytest

from api_schemas.feasibility import obstacles
from api_schemas.requests import TextureRequest
from tests.growing import grow, noise, upload
from worker.images import image_io
from worker.stages import silent
from worker.synthesis.by_example.features import FeatureSpace
from worker.synthesis.by_example.patch_match import NEVER
from worker.synthesis.by_example.several_nearest import several_exactly, several_quickly


def bytes_of_noise(height, width, seed=1):
    return np.random.default_rng(seed).integers(0, 256, (height, width, 3)).astype(np.uint8)


def all_costs(target, source, side):
    """Of all pairs of patches, (rows, columns, places)."""

    def patches(picture):
        windows = np.lib.stride_tricks.sliding_window_view(picture, (side, side), (0, 1))
        return windows.astype(np.int64).reshape(*windows.shape[:2], -1)

    ours, theirs = patches(target), patches(source)
    flat = theirs.reshape(-1, theirs.shape[-1])
    return ((ours[:, :, np.newaxis] - flat) ** 2).sum(axis=-1)


def everything(features):
    return np.ones(features.shape[:2], bool)


def passes(target, source, side, count, times, seed=1):
    fields = several_quickly(target, source, everything(source), side, seed, count)
    return [
        type(field)(*(part.copy() for part in field))
        for field in itertools.islice(fields, times + 1)
    ]


def test_the_exact_ones_are_those_of_trying_everything():
    target, source = bytes_of_noise(12, 9, 1), bytes_of_noise(11, 13, 2)

    field = several_exactly(target, source, everything(source), 4, 5, silent)

    costs = all_costs(target, source, 4)
    order = costs.argsort(axis=-1, kind="stable")[..., :5]
    assert (field.costs == np.take_along_axis(costs, order, axis=-1)).all()
    assert (field.rows * 10 + field.columns == order).all()


def test_the_quick_ones_are_others_each_in_order_and_cost_what_they_say():
    target, source = bytes_of_noise(20, 26, 1), bytes_of_noise(14, 31, 2)

    fields = passes(target, source, 5, 4, 3)

    costs = all_costs(target, source, 5)
    energies = []
    for field in fields:
        places = field.rows * 27 + field.columns
        assert (np.take_along_axis(costs, places, axis=-1) == field.costs).all()
        assert (np.diff(field.costs, axis=-1) >= 0).all()
        assert (np.diff(np.sort(places, axis=-1), axis=-1) > 0).all()
        energies.append(field.costs.mean(axis=(0, 1)))
    # Of each rank by itself
    assert (np.diff(energies, axis=0) <= 0).all()


def test_noise_that_was_shifted_is_found_again_and_its_twins_too():
    tile = bytes_of_noise(32, 32)
    source = np.tile(tile, (2, 2, 1))

    *_, field = passes(tile, source, 7, 4, 5)

    # Four places hold each patch of the tile that the doubled picture holds wholly four times
    assert (field.costs[..., 0] == 0).mean() >= 0.95
    inner = field.costs[:25, :25]
    assert (inner == 0).mean() > 0.9


@pytest.mark.corpus
def test_they_cost_little_more_than_the_exact_ones(corpus):
    pictures = [
        image_io.read(corpus / "3_textures" / name, "srgb", "colour", alpha=False)
        for name in ("embark/2.jpg", "embark/1.jpg")
    ]
    target, source = (FeatureSpace.of(image).encode(image)[::4, ::4] for image in pictures)

    *_, field = passes(target, source, 7, 4, 5)

    exact = several_exactly(target, source, everything(source), 7, 4, silent)
    for rank in range(4):
        assert field.costs[..., rank].mean() <= 1.2 * exact.costs[..., rank].mean()


@pytest.mark.parametrize("method", ["exact", "patch_match"])
def test_where_there_are_not_so_many_places_the_distance_is_one(method):
    mask = np.zeros((8, 8, 1), np.float32)
    mask[2:6, 1:6] = 1  # two patches of 4 x 4

    made = grow(
        "nearest_neighbour_field", noise(8, 8), (10, 10), target=noise(10, 10, seed=2),
        patch=4, nearest=3, method=method, exemplar_mask=mask,
    )  # fmt: skip

    first, second, third = (made.layers[f"distance{n}"].pixels for n in ("", "_2", "_3"))
    assert (first <= second).all()
    assert (second < 1).all()
    assert (third == 1).all()
    offsets = [made.layers[f"offset{n}"].pixels for n in ("", "_3")]
    assert (offsets[0] == offsets[1]).all()
    assert np.isfinite(made.report["energies"]).all()


def test_layers_of_more_places_than_are_looked_for_are_refused():
    texture = {
        "technique": "nearest_neighbour_field",
        "exemplar": upload(0),
        "target": upload(1),
        "nearest": 3,
    }
    layers = ["offset_3", "offset_4", "distance_2"]
    request = TextureRequest.model_validate(
        {"texture": texture, "output": {"layers": layers, "format": "exr"}}
    )

    found = [obstacle.pointer for obstacle in obstacles(request)]

    assert found == ["/output/layers/1"]


def test_bits_do_not_depend_on_threads(with_threads):
    target, source = bytes_of_noise(150, 40, 1), bytes_of_noise(40, 40, 2)

    one, two = (with_threads(n, lambda: passes(target, source, 7, 3, 2)[-1]) for n in (1, 2))

    for part, other in zip(one, two, strict=True):
        assert part.tobytes() == other.tobytes()
    assert (one.costs < NEVER).all()
