"""What every technique makes of a guide's weight, and of pictures parts of which are kept."""

import numpy as np
import pytest

from api_schemas.by_example import GuidedSpec, KeepingSpec
from api_schemas.language import FAMILIES
from tests.growing import grow, noise, sources

TEXTURES = FAMILIES["textures"].items()
GUIDED = [name for name, spec in TEXTURES if issubclass(spec, GuidedSpec)]
KEEPING = [name for name, spec in TEXTURES if issubclass(spec, KeepingSpec)]


def halves(height, width, left):
    """A grey picture whose left half is as light as `left`, and the right half is not."""
    picture = np.full((height, width, 1), 1 - left, np.float32)
    picture[:, : width // 2] = left
    return picture


@pytest.mark.parametrize("technique", GUIDED)
def test_a_guide_of_no_weight_changes_nothing(technique):
    exemplar, ours = noise(32, 32), halves(32, 32, 1.0)

    made = [
        grow(technique, exemplar, (32, 32), guide=guide, exemplar_guide=ours, guide_weight=0)
        for guide in (halves(32, 32, 1.0), halves(32, 32, 0.0))
    ]

    assert made[0].image.pixels.tobytes() == made[1].image.pixels.tobytes()


@pytest.mark.parametrize("technique", GUIDED)
def test_beside_a_guide_that_counts_alone_the_texture_does_not(technique):
    guides = {"guide": noise(32, 32, 1, 1), "exemplar_guide": noise(32, 32, 1, 2)}

    found = [
        sources(grow(technique, exemplar, (32, 32), guide_weight=1, **guides), exemplar)
        for exemplar in (noise(32, 32, seed=3), noise(32, 32, seed=4))
    ]

    assert (np.array(found[0]) == found[1]).all()


@pytest.mark.parametrize("technique", GUIDED)
def test_a_guide_is_compared_with_the_exemplar_guide(technique):
    # The exemplar is the same all over: only the other picture tells left from right
    exemplar, ours, guide = noise(64, 64), halves(64, 64, 1.0), halves(64, 64, 0.0)

    _, columns = sources(
        grow(technique, exemplar, (64, 64), guide=guide, exemplar_guide=ours), exemplar
    )

    from_the_left = columns < 32
    assert from_the_left[:, 32:].mean() > 0.9
    assert from_the_left[:, :32].mean() < 0.1


@pytest.mark.parametrize("technique", KEEPING)
def test_without_a_mask_what_has_alpha_is_kept(technique):
    exemplar = noise(20, 20)
    keep = np.concatenate([noise(24, 28, seed=1), np.zeros((24, 28, 1), np.float32)], axis=-1)
    keep[:, :9, 3] = 1
    keep[:, 9:] = 0

    made = grow(technique, exemplar, (28, 24), keep=keep)

    pixels, place = made.image.pixels, sources(made, exemplar)
    assert pixels[:, :9, :3].tobytes() == keep[:, :9, :3].tobytes()
    right = exemplar[place[0][:, 9:], place[1][:, 9:]]
    assert pixels[:, 9:, :3].tobytes() == right.tobytes()


@pytest.mark.parametrize("technique", KEEPING)
def test_layers_are_0_where_something_is_kept(technique):
    exemplar, keep, stays = noise(20, 20), noise(24, 28, seed=1), np.zeros((24, 28), bool)
    stays[4:12, 3:20] = True
    height = noise(20, 20, 1, 5) + 1

    made = grow(
        technique, exemplar, (28, 24), height=height,
        keep=keep, keep_mask=stays[..., np.newaxis].astype(np.float32),
    )  # fmt: skip

    for name in ("source", "height"):
        layer = made.layers[name].pixels
        assert not layer[stays].any()
        assert layer[~stays].all()


@pytest.mark.parametrize("technique", KEEPING)
def test_what_grows_depends_on_what_is_kept(technique):
    exemplar, mask = noise(20, 20), halves(24, 28, 1.0)

    places = [
        sources(grow(technique, exemplar, (28, 24), keep=keep, keep_mask=mask), exemplar)
        for keep in (noise(24, 28, seed=1), noise(24, 28, seed=2))
    ]

    assert (np.array(places[0])[..., 14:] != np.array(places[1])[..., 14:]).any(axis=0).mean() > 0.2
