"""Channels taken out and put together again."""

import numpy as np
import pytest

from worker.images.image import Image

ASSET = {"technique": "image", "asset": "0" * 64}


def constant(*value):
    return {"technique": "constant", "value": list(value)}


@pytest.mark.parametrize(
    ("value", "channel", "expected"),
    [
        ((0.25, 0.5, 0.75), "r", 0.25),
        ((0.25, 0.5, 0.75), "b", 0.75),
        ((0.25, 0.5, 0.75), "a", 1),
        ((0.25, 0.5, 0.75), "luminance", 0.2126 * 0.25 + 0.7152 * 0.5 + 0.0722 * 0.75),
        ((0.25,), "g", 0.25),
        ((0.25,), "luminance", 0.25),
        ((0.5, 0.25), "r", 0.5),
        ((0.5, 0.25), "a", 0.25),
        ((0.2, 0.4, 0.6, 0.5), "g", 0.4),
        ((0.2, 0.4, 0.6, 0.0), "g", 0),
    ],
)
def test_of_colour_the_straight_channel_is_taken(make, value, channel, expected):
    pixels = make(
        {"technique": "pick_channel", "input": constant(*value), "channel": channel}, (2, 1)
    )

    assert pixels.shape == (1, 2, 1)
    assert pixels == pytest.approx(expected, rel=1e-6)


@pytest.mark.parametrize(("channel", "expected"), [("r", 3), ("g", -4), ("b", 0), ("a", 1)])
def test_of_data_two_channels_are_red_and_green(make, channel, expected):
    texel = np.float32([3, -4]).reshape(1, 1, 2)
    body = {"technique": "pick_channel", "input": ASSET, "channel": channel}

    found = make(
        {"technique": "pack_channels", "r": body},
        (1, 1),
        lambda spec, meaning: Image(texel, meaning),
    )

    assert found[0, 0, 0] == expected


def test_what_is_packed_is_found_again(make):
    parts = {name: {"technique": "perlin", "seed": seed} for seed, name in enumerate("rgba")}
    packed = {"technique": "pack_channels", **parts}

    for name in "rgb":
        picked = make({"technique": "pick_channel", "input": packed, "channel": name}, (9, 8))
        assert picked.tobytes() == make(parts[name], (9, 8)).tobytes()
    assert make(packed, (9, 8))[..., 3:].tobytes() == make(parts["a"], (9, 8)).tobytes()


def test_numbers_fill_channels_and_the_fourth_may_be_absent(make):
    three = make({"technique": "pack_channels", "g": 0.5}, (1, 1))
    four = make({"technique": "pack_channels", "b": -2.0, "a": 0.25}, (1, 1))

    assert three[0, 0].tolist() == [0, 0.5, 0]
    assert four[0, 0].tolist() == [0, 0, -2, 0.25]
