"""Texels of bump maps and reliefs: what they mean (T10, T12)."""

import numpy as np
import pytest

from worker.images.image import Image
from worker.images.relief import Decoded, Normals, Products, Slopes, decode, prepared


def test_a1_signed_and_unsigned_bytes_are_decoded_as_the_book_says():
    signed = np.array([-128, -127, 0, 64, 127])
    held = (signed % 256) / 255  # as a picture holds a byte in two's complement

    assert decode(held, "snorm8") == pytest.approx([-1, -1, 0, 64 / 127, 1], abs=6e-8)
    assert pytest.approx(0.503937008, abs=1e-9) == 64 / 127
    unsigned = decode(np.array([0, 128, 255]) / 255, "unorm8")
    assert unsigned == pytest.approx([-1, 0.003921569, 1], abs=6e-8)  # float32 rounds them


def test_unsigned_bytes_have_no_zero():
    around = decode(np.array([127, 128]) / 255, "unorm8")

    assert around == pytest.approx([-1 / 255, 1 / 255], abs=1e-8)


def test_every_byte_survives_float32_and_is_decoded_right():
    bytes_held = np.arange(256)

    found = decode((bytes_held / 255).astype(np.float32), "snorm8")

    expected = np.maximum(bytes_held.astype(np.uint8).view(np.int8).astype(float), -127) / 127
    assert found == pytest.approx(expected, abs=6e-8)


def test_floats_are_the_tilts_themselves():
    assert decode(np.float32([-3.5, 0, 2]), "float").tolist() == [-3.5, 0, 2]


@pytest.mark.parametrize("bad", [np.nan, np.inf, -np.inf])
@pytest.mark.parametrize("encoding", ["snorm8", "unorm8", "float"])
def test_what_is_no_number_does_not_come_through(encoding, bad):
    image = Image(np.float32([[[bad, 0.5]]]), "data")

    assert np.isfinite(prepared(image, Decoded(encoding)).pixels).all()


def test_one_channel_tilts_along_both_directions():
    image = Image(np.float32([[[0.75]]]), "data")

    assert prepared(image, Decoded("unorm8")).pixels.tolist() == [[[0.5, 0.5]]]


def test_x21_bumps_tell_the_squares_of_their_tilts():
    image = Image(np.float32([[[0.5, -2.0], [3e38, 0.0]]]), "data")

    found = prepared(image, Decoded("float", squares=True)).pixels

    assert found[0, 0].tolist() == [0.5, -2.0, 4.25]
    assert np.isfinite(found).all()


@pytest.mark.parametrize(
    ("texel", "number_range", "normal"),
    [
        ([3.0, 0.0, 4.0], "signed", [0.6, 0.0, 0.8]),
        ([0.5, 0.0, 1.0], "unit", [0.0, -(0.5**0.5), 0.5**0.5]),
        ([0.0, 0.0, 0.0], "signed", [0.0, 0.0, 1.0]),
        ([3e38, 3e38, 0.0], "signed", [0.5**0.5, 0.5**0.5, 0.0]),
        ([np.nan, np.nan, -2.0], "signed", [0.0, 0.0, -1.0]),
        ([1.0], "unit", [3**-0.5] * 3),
        ([1.0, 0.5], "unit", [0.5**0.5, 0.0, -(0.5**0.5)]),
        ([0.5, 0.5, 1.0, 0.25], "unit", [0.0, 0.0, 1.0]),
    ],
)
def test_x21_normals_get_unit_length(texel, number_range, normal):
    found = prepared(Image(np.float32([[texel]]), "data"), Normals(number_range)).pixels

    assert found[0, 0] == pytest.approx(normal, abs=1e-7)


def relief(heights, channel=0, wrap=("repeat", "repeat")):
    image = Image(np.float32(heights).reshape(*np.shape(heights)[:2], -1), "data")
    return prepared(image, Slopes(channel, wrap)).pixels


def test_slopes_are_per_tile_with_v_up():
    side = 64
    u, v = np.meshgrid((np.arange(side) + 0.5) / side, 1 - (np.arange(side) + 0.5) / side)

    found = relief(3 * u - 2 * v, wrap=("clamp", "clamp"))[1:-1, 1:-1]

    assert found[..., 1] == pytest.approx(np.full((62, 62), 3), abs=1e-5)
    assert found[..., 2] == pytest.approx(np.full((62, 62), -2), abs=1e-5)


def test_slopes_go_round_the_edges_of_what_repeats_only():
    row = [[0.0, 1.0, 2.0, 5.0]]

    assert relief(row)[0, :, 1].tolist() == [-8.0, 4.0, 8.0, -4.0]
    assert relief(row, wrap=("clamp", "repeat"))[0, :, 1].tolist() == [2.0, 4.0, 8.0, 6.0]


def test_a_channel_that_is_missing_is_flat():
    assert relief(np.zeros((2, 2, 3)), channel=3).tolist() == [[[1.0, 0.0, 0.0]] * 2] * 2
    assert relief(np.arange(4.0).reshape(2, 2), channel=2)[..., 0].tolist() == [[0, 1], [2, 3]]


def test_slopes_of_holes_and_cliffs_are_numbers():
    found = relief([[np.nan, np.inf], [-np.inf, 3e38]])

    assert np.isfinite(found).all()


def test_products_are_those_of_slopes_along_u_and_v():
    tilts = Image(np.float32([[[0.5, -0.25]]]), "data")
    normal = Image(np.float32([[[-0.6, 0.0, 0.8]]]), "data")
    heights = Image(np.float32([[[0.0], [1.0], [0.0], [0.0]]]), "data")

    found = prepared(tilts, Products(Decoded("float"))).pixels
    assert found.tolist() == [[[0.25, -0.125, 0.0625]]]
    slopes = prepared(normal, Normals("signed", slopes=True)).pixels
    np.testing.assert_allclose(slopes, [[[-0.75, 0.0, 1.0]]], rtol=1e-6)
    found = prepared(normal, Products(Normals("signed", slopes=True))).pixels
    np.testing.assert_allclose(found, [[[0.5625, 0.0, 0.0]]], rtol=1e-6)
    # Rises per tile of four texels: half a step each way
    found = prepared(heights, Products(Slopes(0, ("repeat", "repeat")))).pixels
    assert found[0, :, 0].tolist() == [4.0, 0.0, 4.0, 0.0]


def test_a_normal_that_lies_in_the_surface_has_a_slope_of_a_hundred():
    lying = Image(np.float32([[[1.0, 0.0, 0.0]], [[0.0, -1.0, -1e-9]]]), "data")

    found = prepared(lying, Normals("signed", slopes=True)).pixels

    assert found.tolist() == [[[100.0, 0.0, 1.0]], [[0.0, -100.0, 1.0]]]
