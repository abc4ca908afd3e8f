"""T50: published patterns of Gray and Scott's chemicals told apart by numbers alone.

The classes are those of 5_reference/grayscott/parameters.csv (Pearson, 1993, as Munafo names them).
"""

import csv

import numpy as np
import pytest
from scipy import ndimage

from api_schemas.textures.gray_scott import GrayScottSpec
from worker.synthesis.gray_scott import initial_dish, react

SETTLING = 8000
LATER = 500

# By class, or by name where the list has none
EXPECTED = {
    "delta": "holes",
    "theta": "stripes",
    "kappa": "stripes",
    "epsilon": "restless spots",
    "Self-replicating spots": "spots",
    "Chaos to Turing negatons": "holes",
    "Negatons": "holes",
    "Mazes": "stripes",
    "Warring microbes": "restless spots",
    "Moving spots": "restless spots",
}


def spec(feed, kill, steps):
    return GrayScottSpec(
        technique="gray_scott", size=[128, 128], feed=feed, kill=kill, drops=6, seed=1, steps=steps
    )


def pieces(mask):
    """Count connected pieces of a tile whose edges are joined."""
    return ndimage.label(np.tile(mask, (2, 2)))[1] / 4


def kind_of(v, later):
    """Name a pattern by how much of the dish is full, in how many pieces, and whether it rests."""
    if v.max() < 0.05:
        return "extinct"
    full = v > (v.min() + v.max()) / 2
    share, restless = full.mean(), np.abs(later - v).mean() > 0.03
    if share > 0.6 and pieces(~full) > 20:
        kind = "holes"
    elif share < 0.3 and pieces(full) > 20:
        kind = "spots"
    else:
        kind = "stripes"
    return f"restless {kind}" if restless else kind


def grown(feed, kill):
    dish = react(*initial_dish(spec(feed, kill, 0)), spec(feed, kill, SETTLING))
    return dish[1], react(*dish, spec(feed, kill, LATER))[1]


@pytest.mark.corpus
@pytest.mark.parametrize("name", EXPECTED)
def test_t50_a_class_is_told_by_its_statistics(name, corpus):
    with (corpus / "5_reference/grayscott/parameters.csv").open() as file:
        rows = [row for row in csv.DictReader(file) if row["class"] == name]

    kinds = {kind_of(*grown(float(row["F"]), float(row["k"]))) for row in rows}

    assert kinds == {EXPECTED[name]}


def test_t50_too_much_kill_is_extinction():
    assert kind_of(*grown(0.03, 0.08)) == "extinct"


def test_t50_spots_of_one_drop_divide_until_the_dish_is_full():
    one = spec(0.03, 0.063, 0).model_copy(update={"drops": 1})
    dish = initial_dish(one)

    counts = []
    for _ in range(4):
        dish = react(*dish, one.model_copy(update={"steps": 2000}))
        counts.append(pieces(dish[1] > 0.15))

    assert counts[0] < 10
    assert counts == sorted(counts)
    assert counts[-1] > 5 * counts[0]
