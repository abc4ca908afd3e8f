"""PNG pictures against Pillow, an independent reader, and against the specification."""

import struct
import zlib
from collections.abc import Callable
from pathlib import Path

import numpy as np
import PIL.Image
import pytest

from worker.images.image_io import measure, read


def codes_read(path: Path, bits: int) -> np.ndarray:
    """The stored codes: linear numbers times the highest code are whole."""
    numbers = read(path, "linear", "data").pixels.astype(np.float64) * (2**bits - 1)
    assert np.abs(numbers - np.rint(numbers)).max() < 0.01
    return np.rint(numbers).astype(np.int64)


def pillow_codes(path: Path, channels: int) -> np.ndarray:
    with PIL.Image.open(path) as picture:
        if picture.mode.startswith("I"):  # 16-bit grey, whose transparent value is only told
            grey = np.asarray(picture, np.int64)
            alpha = np.where(grey == picture.info.get("transparency", -1), 0, 65535)
            return np.stack([grey, alpha], axis=2)[..., :channels]
        mode = {1: "L", 2: "LA", 3: "RGB", 4: "RGBA"}[channels]
        codes = np.asarray(picture.convert(mode), np.int64)
    return codes.reshape(*codes.shape[:2], channels)


@pytest.mark.corpus
def test_every_valid_pngsuite_file_has_the_pixels_an_independent_reader_finds(corpus: Path) -> None:
    files = sorted((corpus / "5_reference" / "pngsuite_valid").glob("*.png"))
    assert len(files) >= 60
    for path in files:
        facts = measure(path)
        ours = codes_read(path, facts["bits"])
        theirs = pillow_codes(path, facts["channels"])
        if facts["bits"] == 16 and theirs.max() <= 255:
            ours = ours >> 8  # Pillow keeps the upper byte of 16-bit colour

        # A name's last digits are the bits of its samples (PngSuite, van Schaik 2011).
        assert facts["bits"] == (16 if path.stem.endswith("16") else 8), path.name
        assert (facts["width"], facts["height"]) == theirs.shape[1::-1], path.name
        assert np.array_equal(ours, theirs), path.name


def header(colour: int, bits: int, width: int = 2, height: int = 1) -> tuple[str, bytes]:
    return "IHDR", struct.pack(">IIBBBBB", width, height, bits, colour, 0, 0, 0)


END = ("IEND", b"")


def test_palettes_and_their_transparency_are_expanded(png_file: Callable[..., Path]) -> None:
    path = png_file(
        header(3, 8),
        ("PLTE", bytes([255, 0, 0, 0, 0, 255])),
        ("tRNS", bytes([255, 51])),
        ("IDAT", zlib.compress(bytes([0, 0, 1]))),
        END,
    )

    assert measure(path)["has_alpha"]
    assert codes_read(path, 8).tolist() == [[[255, 0, 0, 255], [0, 0, 255, 51]]]


@pytest.mark.parametrize(("bits", "pack"), [(8, ">BB"), (16, ">HH")])
def test_a_transparent_grey_becomes_alpha(
    png_file: Callable[..., Path], bits: int, pack: str
) -> None:
    top = 2**bits - 1
    path = png_file(
        header(0, bits),
        ("tRNS", struct.pack(">H", 7)),
        ("IDAT", zlib.compress(b"\0" + struct.pack(pack, 7, top))),
        END,
    )

    codes = codes_read(path, bits)

    assert measure(path)["has_alpha"]
    assert measure(path)["bits"] == bits
    assert codes[0, :, -1].tolist() == [0, top]
    assert codes[0, :, 0].tolist() == [7, top]


def test_sixteen_bits_stay_sixteen(png_file: Callable[..., Path]) -> None:
    samples = struct.pack(">6H", 1, 257, 65535, 32768, 0, 12345)
    path = png_file(header(2, 16), ("IDAT", zlib.compress(b"\0" + samples)), END)

    assert codes_read(path, 16).tolist() == [[[1, 257, 65535], [32768, 0, 12345]]]


def test_gamma_and_chromaticity_chunks_change_nothing(png_file: Callable[..., Path]) -> None:
    picture = ("IDAT", zlib.compress(bytes([0, 10, 200])))
    plain = read(png_file(header(0, 8), picture, END), "srgb", "colour").pixels
    chromaticities = struct.pack(">8I", 31270, 32900, 73000, 27000, 12000, 80000, 14000, 5000)
    claimed = png_file(
        header(0, 8), ("gAMA", struct.pack(">I", 100000)), ("cHRM", chromaticities), picture, END
    )

    assert np.array_equal(read(claimed, "srgb", "colour").pixels, plain)


def test_one_bit_grey_is_black_and_white(png_file: Callable[..., Path]) -> None:
    path = png_file(header(0, 1), ("IDAT", zlib.compress(bytes([0, 0b01000000]))), END)

    assert codes_read(path, 8).tolist() == [[[0], [255]]]
