"""Integer codes of files to and from linear float32, 8 and 16 bits, exact both ways.

Decoding is a table of the curve's values, one per code. Encoding gives the code nearest to the
float64 curve for every float32 there is: a guess that is off by at most one, corrected by comparing
with the least float32 of the next code. It works in blocks that stay in the second-level cache.
"""

from collections.abc import Callable
from functools import cache, partial
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from api_schemas.output import PngBits
from worker.images.colour import linear_from_srgb, srgb_from_linear

Transfer = Literal["srgb", "linear"]
Codes = NDArray[np.uint8] | NDArray[np.uint16]

_BLOCK = 1 << 15


def linear_from_codes(codes: Codes, transfer: Transfer) -> NDArray[np.float32]:
    """Decode uint8 or uint16 codes of any shape to linear float32 in 0..1."""
    return _decoding_table(codes.dtype.itemsize, transfer).take(codes)


def codes_from_linear(linear: NDArray[np.float32], bits: PngBits, transfer: Transfer) -> Codes:
    """Encode linear float32 of any shape to the nearest codes.

    Below 0 and NaN become 0, above 1 the highest code.
    """
    encode = _ENCODERS[bits, transfer]
    values = np.ascontiguousarray(linear).reshape(-1)
    codes: NDArray[Any] = np.empty(values.size, np.uint8 if bits == 8 else np.uint16)
    for start in range(0, values.size, _BLOCK):
        block = slice(start, start + _BLOCK)
        # fmax, unlike maximum, gives the other number when one is NaN.
        clipped = np.fmax(values[block], np.float32(0))
        np.minimum(clipped, np.float32(1), out=clipped)
        codes[block] = encode(clipped)
    return codes.reshape(linear.shape)


@cache
def _decoding_table(itemsize: int, transfer: Transfer) -> NDArray[np.float32]:
    top = 2 ** (8 * itemsize) - 1
    encoded = np.arange(top + 1, dtype=np.float64) / top
    linear = linear_from_srgb(encoded) if transfer == "srgb" else encoded
    return linear.astype(np.float32)


def _encode_srgb_8(values: NDArray[np.float32]) -> Codes:
    # No two codes begin among the floats that share their upper 16 bits.
    guess = _codes_of_upper_halves().take(values.view(np.uint32) >> 16)
    guess += values >= _code_floors(8)[1:].take(guess)
    return guess


@cache
def _codes_of_upper_halves() -> NDArray[np.uint8]:
    halves = np.arange((np.float32(1).view(np.uint32) >> 16) + 1, dtype=np.uint32)
    least = (halves << 16).view(np.float32)
    return (np.searchsorted(_code_floors(8), least, side="right") - 1).astype(np.uint8)


def _encode_srgb_16(values: NDArray[np.float32]) -> Codes:
    # The float32 power is right within a hundredth of a code.
    power = np.float32(1.055) * np.power(values, np.float32(1 / 2.4)) - np.float32(0.055)
    encoded = np.where(values <= np.float32(0.0031308), np.float32(12.92) * values, power)
    guess = np.rint(encoded * np.float32(65535)).astype(np.intp)
    floors = _code_floors(16)
    guess -= values < floors.take(guess)
    guess += values >= floors[1:].take(guess)
    return guess.astype(np.uint16)


@cache
def _code_floors(bits: PngBits) -> NDArray[np.float32]:
    """Give the least float32 that each code is nearest to, -inf for 0, and inf past the top."""
    top = 2**bits - 1
    middles = (np.arange(1, top + 1, dtype=np.float64) - 0.5) / top
    nearest = linear_from_srgb(middles).astype(np.float32)
    too_low = srgb_from_linear(nearest.astype(np.float64)) < middles
    floors = np.where(too_low, np.nextafter(nearest, np.float32(1)), nearest)
    return np.concatenate([[-np.inf], floors, [np.inf]]).astype(np.float32)


def _encode_linear(values: NDArray[np.float32], top: int) -> NDArray[np.float64]:
    # Exact: 24 bits times at most 16 fit float64. The cast that follows drops the fraction.
    return values.astype(np.float64) * top + 0.5


_ENCODERS: dict[tuple[PngBits, Transfer], Callable[[NDArray[np.float32]], NDArray[Any]]] = {
    (8, "srgb"): _encode_srgb_8,
    (16, "srgb"): _encode_srgb_16,
    (8, "linear"): partial(_encode_linear, top=255),
    (16, "linear"): partial(_encode_linear, top=65535),
}
