"""Blends against numbers worked out by hand."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from api_schemas.textures.constant import ConstantSpec
from api_schemas.textures.mix import MixSpec
from worker.images.image import Image
from worker.stages import silent
from worker.synthesis._channels import matched
from worker.synthesis.mix import synthesize

ASSET = {"technique": "image", "asset": "0" * 64}
GREY = ConstantSpec(technique="constant", value=0.5)
NUMBERS = st.floats(-(2.0**127), 2.0**127, width=32)


def constant(*value):
    return {"technique": "constant", "value": list(value)}


def mix(a, b, **fields):
    return {"technique": "mix", "a": a, "b": b, **fields}


def image(meaning, *texel):
    return Image(np.float32(texel).reshape(1, 1, -1), meaning)


def test_a_number_blends_everywhere_alike(make):
    pixels = make(mix(constant(1.0, 2.0, 4.0), constant(3.0, 0.0, 0.0), amount=0.25), (3, 2))

    assert pixels.shape == (2, 3, 3)
    assert (pixels == [1.5, 1.5, 3.0]).all()


def test_a_texture_blends_point_by_point_and_is_held_within_0_and_1(make):
    mask = np.float32([[-2, 0, 0.25], [0.75, 1, 5]])[..., np.newaxis]
    body = mix(constant(10.0), constant(20.0), amount=ASSET)

    pixels = make(body, (3, 2), lambda spec, meaning: Image(mask, meaning))

    assert pixels[..., 0].tolist() == [[10, 10, 12.5], [17.5, 20, 20]]


def test_the_mask_is_read_as_data_and_the_pictures_as_their_slot_is(make):
    meanings = []

    def load(spec, meaning):
        meanings.append(meaning)
        return Image(np.zeros((1, 1, 1), np.float32), meaning)

    make(mix(ASSET, constant(1.0), amount=ASSET), (1, 1), load)

    assert sorted(meanings) == ["colour", "data"]


def blended(a, b, amount):
    spec = MixSpec(technique="mix", a=GREY, b=GREY, amount=amount)
    return synthesize(spec, (1, 1), {"a": image("data", a), "b": image("data", b)}, silent).pixels[
        0, 0, 0
    ]


@given(a=NUMBERS, b=NUMBERS, amount=st.floats(0, 1))
def test_a_blend_lies_between_its_ends(a, b, amount):
    value = blended(a, b, amount)

    assert min(a, b) <= value <= max(a, b)


@given(a=NUMBERS, amount=st.floats(0, 1))
def test_a_blend_of_equals_is_the_same(a, amount):
    value = blended(a, a, amount)

    # Two products and a sum, rounded in float64, then to float32
    assert value == pytest.approx(a, rel=2**-24, abs=1e-44)


def test_transparent_paint_leaves_its_ground_in_the_right_measure(make):
    # Half of opaque (1, 0, 0) and half of nothing is half-covered red, premultiplied
    pixels = make(mix(constant(1.0, 0.0, 0.0), constant(0.0, 1.0, 0.0, 0.0)), (1, 1))

    assert pixels[0, 0].tolist() == [0.5, 0, 0, 0.5]


@pytest.mark.parametrize(
    ("a", "b", "expected"),
    [
        (image("colour", 2), image("colour", 3, 4, 5), [2, 2, 2]),
        (image("colour", 2), image("colour", 0.5, 0.5), [2, 1]),
        (image("colour", 2, 0.5), image("colour", 1, 1, 1), [2, 2, 2, 0.5]),
        (image("data", 2), image("colour", 1, 1, 1, 0.5), [2, 2, 2, 1]),
        (image("data", 2), image("data", 1, 1), [2, 2]),
        (image("data", 2, 3), image("data", 1, 1, 1, 1), [2, 3, 0, 0]),
    ],
)
def test_channels_are_brought_together(a, b, expected):
    first, second = matched(a, b)
    other, _ = matched(b, a)

    assert first[0, 0].tolist() == expected
    assert first.shape == second.shape == other.shape


@pytest.mark.parametrize(
    ("a", "b", "meaning"),
    [("data", "data", "data"), ("data", "colour", "colour"), ("colour", "colour", "colour")],
)
def test_only_data_with_data_is_data(a, b, meaning):
    spec = MixSpec(technique="mix", a=GREY, b=GREY)

    assert synthesize(spec, (1, 1), {"a": image(a, 1), "b": image(b, 1)}, silent).meaning == meaning
