"""Nearest patches: T58 exact, T59 PatchMatch, case A20 of the reference."""

import itertools

import numpy as np
import pytest
from pydantic import TypeAdapter

from api_schemas.members import Texture
from worker.images import image_io
from worker.images.image import Image
from worker.stages import silent
from worker.synthesis import outcome
from worker.synthesis.by_example.features import FeatureSpace
from worker.synthesis.by_example.field_search import exact_field, quick_field


def bytes_of_noise(height, width, seed=1):
    return np.random.default_rng(seed).integers(0, 256, (height, width, 3)).astype(np.uint8)


def everything(features):
    return np.ones(features.shape[:2], bool)


def passes(target, source, side, count, seed=1):
    """The mean cost after 0, 1, .. passes, and the last field."""
    energies = []
    for field in itertools.islice(
        quick_field(target, source, everything(source), side, seed), count + 1
    ):
        energies.append(field.costs.mean())
    return energies, field


@pytest.mark.parametrize("seed", range(5))
def test_a20_shifted_noise_is_found_again(seed):
    source = bytes_of_noise(64, 64, seed)
    target = np.roll(source, (3, 5), axis=(0, 1))

    energies, field = passes(target, source, 7, 5, seed=1)

    rows, columns = np.indices(field.rows.shape)
    # Patches by upper left corner: centres from row 6, column 8 on are corners from 3, 5 on
    exact = (field.rows - rows == -3) & (field.columns - columns == -5)
    assert exact[3:, 5:].mean() >= 0.95
    assert (np.diff(energies) <= 0).all()
    assert (field.costs >= 0).all()
    assert (field.costs[exact] == 0).all()


def brute(target, source, side):
    shape = [n - side + 1 for n in target.shape[:2]]
    other = [n - side + 1 for n in source.shape[:2]]
    best = np.full(shape, np.iinfo(np.int64).max)
    where = np.zeros((*shape, 2), int)
    for v, u in np.ndindex(*other):
        patch = source[v : v + side, u : u + side].astype(np.int64)
        for y, x in np.ndindex(*shape):
            cost = ((target[y : y + side, x : x + side] - patch) ** 2).sum()
            if cost < best[y, x]:
                best[y, x], where[y, x] = cost, (v, u)
    return best, where


def test_the_exact_field_is_that_of_trying_everything():
    target, source = bytes_of_noise(12, 9, 1), bytes_of_noise(11, 13, 2)

    field = exact_field(target, source, everything(source), 4, silent)

    costs, where = brute(target, source, 4)
    assert (field.costs == costs).all()
    assert (np.stack(field[:2], axis=-1) == where).all()


def test_a_picture_is_its_own_nearest():
    picture = bytes_of_noise(20, 24)

    field = exact_field(picture, picture, everything(picture), 5, silent)

    rows, columns = np.indices(field.rows.shape)
    assert (field.rows == rows).all()
    assert (field.columns == columns).all()
    assert not field.costs.any()


def test_the_quick_field_is_never_better_than_the_exact_one():
    target, source = bytes_of_noise(30, 30, 1), bytes_of_noise(26, 31, 2)

    _, quick = passes(target, source, 3, 3)
    exact = exact_field(target, source, everything(source), 3, silent)

    assert (quick.costs >= exact.costs).all()


@pytest.mark.corpus
@pytest.mark.parametrize(
    ("first", "second"),
    [
        ("skimage/brick.png", "skimage/grass.png"),
        ("skimage/camera.png", "skimage/brick.png"),
        ("embark/1.jpg", "embark/2.jpg"),
    ],
)
def test_five_passes_come_within_a_fifth_of_the_nearest(corpus, first, second):
    def features(name):
        image = image_io.read(corpus / "3_textures" / name, "srgb", "colour", alpha=False)
        return FeatureSpace.of(image).encode(image)[:128, :128]

    target, source = features(first), features(second)
    target = np.ascontiguousarray(target[..., : source.shape[2]])
    source = np.ascontiguousarray(source[..., : target.shape[2]])

    energies, quick = passes(target, source, 7, 5)
    exact = exact_field(target, source, everything(source), 7, silent)

    assert (np.diff(energies) <= 0).all()
    assert quick.costs.mean() <= 1.2 * exact.costs.mean()


def make(target, source, **fields):
    pictures = {"0" * 64: target, "1" * 64: source}

    def load(spec, meaning):
        return Image(pictures[spec.asset], meaning)

    body = {
        "technique": "nearest_neighbour_field",
        "target": {"technique": "image", "asset": "0" * 64},
        "exemplar": {"technique": "image", "asset": "1" * 64},
        **fields,
    }
    size = (target.shape[1], target.shape[0])
    return outcome(TypeAdapter(Texture).validate_python(body), size, load)


@pytest.mark.parametrize("method", ["exact", "patch_match"])
@pytest.mark.parametrize("shape", [(20, 30), (1, 1), (3, 40)])
def test_the_layers_agree_with_the_picture(method, shape):
    target = np.random.default_rng(1).random((*shape, 3), np.float32)
    source = np.random.default_rng(2).random((17, 13, 3), np.float32)

    made = make(target, source, method=method)

    rows, columns = np.indices(shape)
    across, down = np.moveaxis(made.layers["offset"].pixels.astype(int), -1, 0)
    copied = source[rows + down, columns + across]
    assert made.image.pixels.tobytes() == copied.tobytes()
    u, v = np.moveaxis(made.layers["source"].pixels, -1, 0)
    assert u * 13 - 0.5 == pytest.approx(columns + across, abs=1e-4)
    assert (1 - v) * 17 - 0.5 == pytest.approx(rows + down, abs=1e-4)
    assert made.layers["distance"].pixels.min() >= 0
    assert made.layers["distance"].pixels.max() <= 1


def test_of_an_equal_picture_nothing_is_away():
    target = np.random.default_rng(1).random((24, 24, 3), np.float32)

    made = make(target, target, method="exact")

    assert made.image.pixels.tobytes() == target.tobytes()
    assert not made.layers["distance"].pixels.any()
    assert made.report["energies"] == [0.0]


def test_bits_do_not_depend_on_threads(with_threads):
    target, source = bytes_of_noise(300, 40, 1), bytes_of_noise(40, 50, 2)

    one, two = (with_threads(n, lambda: passes(target, source, 7, 3)[1]) for n in (1, 2))

    assert all(a.tobytes() == b.tobytes() for a, b in zip(one, two, strict=True))
