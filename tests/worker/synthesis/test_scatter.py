"""T44: vegetation where noise is high, and no two plants in one place."""

import numpy as np
import pytest
from pydantic import TypeAdapter

from api_schemas.members import Texture
from worker.images.image import Image
from worker.synthesis import outcome

ASSET = {"technique": "image", "asset": "0" * 64}
EVERYWHERE = {"technique": "constant", "value": 1.0}


def scattered(size=(256, 256), picture=None, **fields):
    body = {"technique": "scatter", "density": EVERYWHERE, **fields}
    return outcome(TypeAdapter(Texture).validate_python(body), size, lambda *_: picture)


def distances(places):
    apart = np.abs(places[:, np.newaxis, :2] - places[np.newaxis, :, :2])
    apart = np.minimum(apart, 1 - apart)
    return np.sqrt((apart**2).sum(-1)) + 9 * np.eye(len(places))


@pytest.mark.parametrize("spacing", [0.003, 0.02, 0.11, 0.34, 0.5])
def test_no_two_are_nearer_than_asked_across_the_edges_too(spacing):
    places = np.array(scattered(spacing=spacing, tries=5000, most=4096).report["places"])

    assert len(places) > 1
    assert distances(places).min() >= spacing - 2e-7


def test_many_tries_leave_no_room_for_another_one():
    places = np.array(scattered(spacing=0.1, tries=60000).report["places"])

    grid = np.stack(np.meshgrid(*[np.linspace(0, 1, 60)] * 2), axis=-1).reshape(-1, 1, 2)
    apart = np.abs(grid - places[:, :2])
    apart = np.minimum(apart, 1 - apart)
    assert np.sqrt((apart**2).sum(-1)).min(axis=1).max() < 0.1


def test_all_stand_where_the_texture_reaches_the_level():
    u = np.arange(64) / 64
    ramp = Image(np.float32(np.tile(u, (64, 1)))[..., np.newaxis], "data")

    told = scattered((64, 64), ramp, density=ASSET, level=0.75, spacing=0.0).report

    # Columns from 48 of 64 on
    assert told["share_above"] == 0.25
    assert min(u for u, _, _ in told["places"]) >= 0.75
    # Of 2000 tries a quarter stays: 500 +- 19.4
    assert told["count"] == pytest.approx(500, abs=60)


def test_t44_of_many_waves_as_many_plants_as_a_bell_curve_has_above():
    waves, deviations = 64, 1.0
    density = {"technique": "gardner", "count": waves, "frequency": 8, "bandwidth": 24, "seed": 5}
    level = 0.5 + deviations / np.sqrt(8 * waves)

    told = scattered((512, 512), density=density, level=level, spacing=0.0, tries=20000, most=4096)

    # 1 - Phi(1) = .1587 of the tile, known from about 1000 spots, and of the tries as chance has it
    assert told.report["share_above"] == pytest.approx(0.1587, abs=3 * 0.0116)
    assert told.report["count"] / 20000 == pytest.approx(told.report["share_above"], abs=0.008)


def test_discs_have_their_area_and_their_numbers():
    made = scattered((512, 512), spacing=0.1, radius=[0.03, 0.03])

    count = made.report["count"]
    numbers = made.layers["number"].pixels
    assert made.image.pixels.mean() == pytest.approx(count * np.pi * 0.03**2, rel=2e-3)
    assert sorted(set(numbers.ravel())) == list(range(count + 1))
    random = made.layers["random"].pixels
    assert len(set(random[numbers > 0])) == count
    # A disc lies around its place, v up
    u, v, _ = made.report["places"][4]
    rows, columns, _ = np.nonzero(numbers == 5)
    angles = np.exp(2j * np.pi * np.array([(columns + 0.5) / 512, 1 - (rows + 0.5) / 512]))
    middle = (np.angle(angles.mean(axis=1)) / (2 * np.pi)) % 1
    assert middle == pytest.approx([u, v], abs=2e-3)


def test_more_tries_add_to_those_of_fewer_and_there_are_no_more_than_asked():
    few, many = scattered(tries=300).report["places"], scattered(tries=3000).report["places"]

    assert many[: len(few)] == few
    assert len(many) > len(few)
    assert scattered(tries=3000, most=7).report["places"] == many[:7]
    assert scattered(tries=0).report == {"count": 0, "share_above": 1.0, "places": []}


def test_radii_lie_between_the_two_in_either_order():
    radii = np.array(scattered(radius=[0.03, 0.01]).report["places"])[:, 2]

    assert 0.01 <= radii.min() < 0.012
    assert 0.028 < radii.max() <= 0.03
