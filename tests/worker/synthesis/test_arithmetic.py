"""Sums, products and the lesser and greater of textures, against numbers worked out by hand."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from api_schemas.base import FLOAT32_MAX
from worker.images.image import Image
from worker.synthesis._pointwise import combined

ASSET = {"technique": "image", "asset": "0" * 64}


def constant(*value):
    return {"technique": "constant", "value": list(value)}


@pytest.mark.parametrize(
    ("technique", "more", "expected"),
    [
        ("add", {}, [3.25, -1, 2.5]),
        ("add", {"weight": -2.0}, [-0.5, 8, -5]),
        ("multiply", {}, [2.5, -6, 0]),
        ("minimum", {}, [1.25, -3, 0]),
        ("maximum", {}, [2, 2, 2.5]),
    ],
)
def test_numbers_meet_channel_by_channel(make, technique, more, expected):
    pictures = {"a": np.float32([2, 2, 0]), "b": np.float32([1.25, -3, 2.5])}

    def load(spec, meaning):
        return Image(pictures["a" if spec.asset == "0" * 64 else "b"].reshape(1, 1, 3), "data")

    other = {"technique": "image", "asset": "1" * 64}
    pixels = make({"technique": technique, "a": ASSET, "b": other, **more}, (1, 1), load)

    assert pixels[0, 0].tolist() == expected


@pytest.mark.parametrize(
    ("technique", "expected"), [("add", 0.75), ("multiply", 0.125), ("minimum", 0.25)]
)
def test_a_number_stands_for_every_channel(make, technique, expected):
    pixels = make({"technique": technique, "a": constant(0.5, 0.5, 0.5), "b": 0.25}, (3, 2))

    assert pixels.shape == (2, 3, 3)
    assert (pixels == expected).all()


def test_a_grey_tints_a_colour_and_alpha_stays_within_0_and_1(make):
    tinted = make({"technique": "multiply", "a": constant(0.5), "b": constant(1, 0.5, 0)}, (1, 1))
    lit = make({"technique": "add", "a": constant(1, 0, 0, 0.5), "b": constant(1, 0, 0)}, (1, 1))

    assert tinted[0, 0].tolist() == [0.5, 0.25, 0]
    assert lit[0, 0].tolist() == [1.5, 0, 0, 1]


def data(value):
    return Image(np.full((1, 1, 1), value, np.float32), "data")


@pytest.mark.parametrize("value", [np.inf, -np.inf, np.nan, 3e38])
def test_what_no_number_holds_becomes_the_largest(value):
    total = combined(data(value), data(3e38), lambda a, b: a * b + a).pixels

    assert np.isfinite(total).all()
    assert abs(total[0, 0, 0]) in (0, np.float32(FLOAT32_MAX))


@given(*[st.floats(-(2.0**100), 2.0**100, width=32)] * 2)
def test_the_lesser_and_the_greater_add_up_to_both(a, b):
    lesser = combined(data(a), data(b), np.minimum).pixels.item()
    greater = combined(data(a), data(b), np.maximum).pixels.item()

    assert (lesser, greater) == (min(a, b), max(a, b))


@pytest.mark.parametrize("technique", ["add", "multiply", "minimum", "maximum"])
def test_a_picture_has_no_seams_nor_parts(make, technique):
    """Rows are worked on in parts: a picture of many rows is the same as its rows alone."""
    body = {
        "technique": technique,
        "a": {"technique": "perlin", "seed": 1},
        "b": {"technique": "worley", "seed": 2},
    }
    operation = {
        "add": np.add,
        "multiply": np.multiply,
        "minimum": np.minimum,
        "maximum": np.maximum,
    }[technique]

    pixels = make(body, (5, 150))

    assert pixels == pytest.approx(
        operation(make(body["a"], (5, 150)), make(body["b"], (5, 150))), abs=1e-7
    )
