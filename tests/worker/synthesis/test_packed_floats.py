"""Numbers that survive pictures of four bytes, bit by bit (T62)."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from tests.whole_pictures import encode_png
from worker.images import image_io
from worker.images.image import Image
from worker.images.packed_floats import packed, unpacked

ASSET = {"technique": "image", "asset": "0" * 64}


def test_the_bytes_are_those_of_ieee_754_with_the_highest_first():
    # Published bits: 1 is 3f800000, -2 is c0000000, the least denormal number 00000001
    found = packed(np.float32([[1.0, -2.0, 1e-45]])) * 255

    assert found.tolist() == [[[0x3F, 0x80, 0, 0], [0xC0, 0, 0, 0], [0, 0, 0, 1]]]


@given(st.lists(st.floats(width=32, allow_nan=False, allow_infinity=False), min_size=1))
def test_t62_every_number_comes_back_bit_by_bit(numbers):
    held = np.float32([numbers])

    assert unpacked(packed(held)).tobytes() == held.tobytes()


def test_t62_a_png_of_eight_bits_keeps_them_all(make, tmp_path):
    rng = np.random.default_rng(1)
    bits = rng.integers(0, 2**32, (64, 64), dtype=np.uint32)
    numbers = np.where(np.isfinite(bits.view(np.float32)), bits.view(np.float32), 0)
    body = {"technique": "pack_float", "input": ASSET}
    image = Image(make(body, (64, 64), lambda s, m: Image(numbers[..., None], m)), "data")
    file = tmp_path / "packed.png"
    encode_png(image, file, bits=8, transfer="linear")
    read = image_io.read(file, "linear", "data")

    found = make({"technique": "unpack_float", "input": ASSET}, (64, 64), lambda s, m: read)

    assert found[..., 0].tobytes() == numbers.tobytes()


def test_t62_between_packing_and_unpacking_nothing_is_lost(make):
    noise = {"technique": "perlin", "frequency": 3, "seed": 4}
    there = {"technique": "pack_float", "input": noise}

    back = make({"technique": "unpack_float", "input": there}, (32, 32))

    assert back.tobytes() == make(noise, (32, 32))[..., :1].tobytes()


@pytest.mark.parametrize(("channel", "expected"), [("g", 0.25), ("a", 1.0)])
def test_one_channel_is_kept_and_a_missing_alpha_is_one(make, channel, expected):
    body = {"technique": "pack_float", "input": ASSET, "channel": channel}
    pixels = np.float32([[[0.5, 0.25, 0.125]]])

    found = make(body, (1, 1), lambda s, m: Image(pixels, m))

    assert unpacked(found).tolist() == [[expected]]


def test_what_is_not_finite_reads_as_something_finite():
    held = packed(np.float32([[np.nan, np.inf, -np.inf]]))

    assert unpacked(held).tolist() == [[0.0, np.finfo(np.float32).max, np.finfo(np.float32).min]]


@pytest.mark.parametrize("channels", [1, 2, 3, 4])
def test_any_picture_can_be_read(channels):
    pixels = np.float32([[[np.nan, 2.0, -1.0, np.inf][:channels]]])

    assert np.isfinite(unpacked(pixels)).all()
