"""Neighbourhoods in clusters (Popat and Picard, 1993), an option of T53."""

import numpy as np
import pytest

from tests.growing import grow as grow_by
from tests.growing import noise, sources
from worker.synthesis.by_example.clusters import Clusters


def grow(exemplar, size, **fields):
    return grow_by("efros_leung", exemplar, size, window=5, **fields)


def middles(height, width, reach):
    allowed = np.zeros((height, width), bool)
    allowed[reach : height - reach, reach : width - reach] = True
    return allowed


def test_every_place_is_in_the_cluster_whose_mean_is_nearest():
    features = np.random.default_rng(1).integers(0, 256, (14, 17, 2)).astype(np.uint8)
    allowed = middles(14, 17, 2)

    clusters = Clusters.of(features, allowed, 2, 6, seed=3)

    assert sorted(clusters.members) == np.flatnonzero(allowed).tolist()
    assert len(clusters.means) <= 6
    assert clusters.shares.sum() == pytest.approx(1)
    apart = []
    for index, (first, last) in enumerate(zip(clusters.starts, clusters.starts[1:], strict=False)):
        assert clusters.shares[index] == pytest.approx((last - first) / allowed.sum())
        for member in clusters.members[first:last]:
            row, column = divmod(int(member), 17)
            around = features[row - 2 : row + 3, column - 2 : column + 3].astype(int)
            squares = ((clusters.means - around) ** 2).sum(axis=(1, 2, 3))
            assert squares[index] == squares.min()
            apart.append(squares[index])
    assert clusters.variance == pytest.approx(np.mean(apart) / 50)


def test_two_kinds_of_places_are_told_apart():
    features = np.full((20, 40, 1), 40, np.uint8)
    features[:, 20:] = 200
    allowed = middles(20, 40, 1)
    allowed[:, 18:22] = False

    clusters = Clusters.of(features, allowed, 1, 8, seed=0)

    # Of eight random ones, not all lie on the same side; equal ones count once
    assert sorted(clusters.means[:, 0, 0, 0].tolist()) == [40, 200]
    assert clusters.variance == 1


def test_with_one_cluster_all_are_compared_as_without():
    exemplar = noise(20, 24)

    assert (
        grow(exemplar, (30, 26), clusters=1).image.pixels.tobytes()
        == grow(exemplar, (30, 26)).image.pixels.tobytes()
    )


@pytest.mark.parametrize("shape", [(16, 16), (1, 1), (2, 5)])
@pytest.mark.parametrize("tileable", [True, False])
def test_every_pixel_is_one_of_the_exemplars_at_the_place_it_says(shape, tileable):
    exemplar = noise(*shape)

    made = grow(exemplar, (20, 15), clusters=12, tileable=tileable)

    assert made.image.pixels.tobytes() == exemplar[sources(made, exemplar)].tobytes()


def test_what_is_masked_is_never_copied():
    exemplar = noise(24, 24)
    mask = np.ones((24, 24, 1), np.float32)
    mask[10:, 12:] = 0

    rows, columns = sources(grow(exemplar, (30, 30), clusters=8, exemplar_mask=mask), exemplar)

    assert not ((rows >= 10) & (columns >= 12)).any()


@pytest.mark.parametrize("light", [0, 1])
def test_light_goes_on_from_light_and_dark_from_dark(light):
    exemplar = noise(20, 40) * 0.3
    exemplar[:, 20:] += 0.7
    keep = exemplar[:, 20 * light :][:20, :20].copy()
    mask = np.zeros((20, 20, 1), np.float32)
    mask[:4] = 1

    made = grow(exemplar, (20, 20), clusters=6, keep=keep, keep_mask=mask)

    assert ((made.image.pixels.mean(axis=-1) > 0.5) == light).all()


def test_stripes_go_on():
    stripes = np.tile((np.arange(32) // 2 % 2)[:, np.newaxis, np.newaxis], (1, 32, 1))

    pixels = grow(stripes.astype(np.float32), (40, 40), clusters=8).image.pixels

    # Along a stripe nothing changes, across it every second pixel does
    assert (pixels[:, 1:] == pixels[:, :-1]).mean() > 0.95
    assert (pixels[4:] == pixels[:-4]).mean() > 0.9
