"""Stretched values against numbers worked out by hand."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from api_schemas.textures.constant import ConstantSpec
from api_schemas.textures.levels import LevelsSpec
from worker.images.image import Image
from worker.stages import silent
from worker.synthesis.levels import synthesize

NUMBERS = st.floats(-(2.0**127), 2.0**127, width=32)
RANGES = st.lists(st.one_of(NUMBERS, st.floats(-1, 1)), min_size=2, max_size=2)


def levels(values, meaning="data", **fields):
    pixels = np.array(values, np.float32)
    pixels = pixels.reshape(1, -1, 1) if pixels.ndim == 1 else pixels[np.newaxis]
    before = pixels.copy()
    pixels.flags.writeable = False
    spec = LevelsSpec(
        technique="levels", input=ConstantSpec(technique="constant", value=0.0), **fields
    )
    image = synthesize(spec, pixels.shape[1::-1], {"input": Image(pixels, meaning)}, silent)
    assert image.meaning == meaning
    assert pixels.tobytes() == before.tobytes()
    return image.pixels[0].squeeze(-1).tolist() if pixels.shape[2] == 1 else image.pixels[0]


@pytest.mark.parametrize(
    ("fields", "expected"),
    [
        ({}, [0, 0, 0.25, 1, 1]),
        ({"clamp": False}, [-1, 0, 0.25, 1, 4]),
        ({"input_range": [0.0, 0.5]}, [0, 0, 0.5, 1, 1]),
        ({"output_range": [2.0, 6.0]}, [2, 2, 3, 6, 6]),
        ({"input_range": [1.0, 0.0]}, [1, 1, 0.75, 0, 0]),
        ({"input_range": [0.25, 0.25]}, [0, 0, 1, 1, 1]),
        ({"gamma": 2.0}, [0, 0, 0.5, 1, 1]),
        ({"gamma": 0.5, "clamp": False}, [-1, 0, 0.0625, 1, 16]),
        ({"gamma": 2.0, "clamp": False, "output_range": [0.0, 10.0]}, [-10, 0, 5, 10, 20]),
    ],
)
def test_values_go_where_they_should(fields, expected):
    assert levels([-1, 0, 0.25, 1, 4], **fields) == pytest.approx(expected, rel=1e-7)


def test_without_a_field_values_within_0_and_1_stay_bit_for_bit():
    values = np.random.default_rng(1).random(100).astype(np.float32)

    assert levels(values) == values.tolist()


def test_alpha_stays_and_its_colour_is_changed_straight():
    # Straight colours .5, .25 and 0 under alphas .5, 1 and 0
    texels = [[0.25, 0.25, 0.25, 0.5], [0.25, 0.25, 0.25, 1], [0, 0, 0, 0]]

    found = levels(texels, "colour", input_range=[0.0, 0.5], output_range=[1.0, 3.0])

    assert found.tolist() == [[1.5, 1.5, 1.5, 0.5], [2, 2, 2, 1], [0, 0, 0, 0]]


def test_colour_that_overflows_is_held():
    texels = [[1e38, 1.0, 0.0, 1e-30], [1.0, 1e30, 0.0, 1e30]]

    found = levels(texels, "colour", output_range=[0.0, 1e38], clamp=False)

    assert np.isfinite(found).all()
    assert found[:, 3].tolist() == np.float32([1e-30, 1e30]).tolist()


def test_a_fourth_channel_of_data_is_no_alpha():
    found = levels([[0.1, 0.2, 0.3, 0.4]], input_range=[0.0, 0.5])

    assert found[0] == pytest.approx([0.2, 0.4, 0.6, 0.8], rel=1e-6)


@given(
    st.lists(NUMBERS, min_size=1, max_size=5),
    RANGES,
    RANGES,
    st.floats(0.1, 10),
    st.booleans(),
)
def test_every_valid_choice_is_finite_and_clamped_within_its_range(
    values, input_range, output_range, gamma, clamp
):
    found = levels(
        values, input_range=input_range, output_range=output_range, gamma=gamma, clamp=clamp
    )

    assert np.isfinite(found).all()
    if clamp:
        low, high = sorted(np.float32(output_range).tolist())
        assert all(low <= value <= high for value in found)
