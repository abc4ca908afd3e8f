import numpy as np
import pytest

from api_schemas.output import PngBits
from worker.images.codes import Transfer, codes_from_linear, linear_from_codes


def srgb_formula(linear: np.ndarray) -> np.ndarray:
    """IEC 61966-2-1, written out once more."""
    x = linear.astype(np.float64)
    return np.where(x <= 0.0031308, 12.92 * x, 1.055 * x ** (1 / 2.4) - 0.055)


def formula(linear: np.ndarray, transfer: Transfer) -> np.ndarray:
    return srgb_formula(linear) if transfer == "srgb" else linear.astype(np.float64)


@pytest.mark.parametrize("bits", [8, 16])
def test_every_srgb_code_decodes_to_the_formula_rounded_once(bits: PngBits) -> None:
    kind = np.uint8 if bits == 8 else np.uint16
    codes = np.arange(2**bits).astype(kind)
    encoded = codes / (2**bits - 1)
    expected = np.where(encoded <= 0.04045, encoded / 12.92, ((encoded + 0.055) / 1.055) ** 2.4)

    assert np.array_equal(linear_from_codes(codes, "srgb"), expected.astype(np.float32))


@pytest.mark.parametrize("transfer", ["srgb", "linear"])
@pytest.mark.parametrize("bits", [8, 16])
def test_every_code_comes_back(bits: PngBits, transfer: Transfer) -> None:
    codes = np.arange(2**bits).astype(np.uint8 if bits == 8 else np.uint16)

    assert np.array_equal(
        codes_from_linear(linear_from_codes(codes, transfer), bits, transfer), codes
    )


@pytest.mark.parametrize("transfer", ["srgb", "linear"])
@pytest.mark.parametrize("bits", [8, 16])
def test_encoding_gives_the_code_nearest_to_the_float64_formula(
    bits: PngBits, transfer: Transfer
) -> None:
    top = 2**bits - 1
    middles = (np.arange(top) + 0.5) / top
    if transfer == "srgb":
        middles = np.where(middles <= 0.04045, middles / 12.92, ((middles + 0.055) / 1.055) ** 2.4)
    nearest = middles.astype(np.float32)
    around = [np.nextafter(nearest, np.float32(side)) for side in (-1, 2)]
    anywhere = np.random.default_rng(7).random(200_000, np.float32)
    values = np.clip(np.concatenate([nearest, *around, anywhere, anywhere**8]), 0, 1)

    codes = codes_from_linear(values, bits, transfer)

    exact = formula(values, transfer) * top
    assert np.abs(codes - exact).max() <= 0.5 + 1e-9


@pytest.mark.parametrize("transfer", ["srgb", "linear"])
@pytest.mark.parametrize("bits", [8, 16])
def test_what_is_outside_or_no_number_is_clipped(bits: PngBits, transfer: Transfer) -> None:
    values = np.array([np.nan, -np.inf, -1, -0.0, 1, 1.0000001, 7, np.inf], np.float32)
    top = 2**bits - 1

    assert codes_from_linear(values, bits, transfer).tolist() == [0, 0, 0, 0, top, top, top, top]


def test_any_shape_and_layout_is_encoded_where_it_lies() -> None:
    picture = np.random.default_rng(1).random((211, 317, 4), np.float32)  # several blocks and a bit

    flipped = codes_from_linear(picture[::-1, :, :3], 8, "srgb")

    assert np.array_equal(flipped, codes_from_linear(picture, 8, "srgb")[::-1, :, :3])
