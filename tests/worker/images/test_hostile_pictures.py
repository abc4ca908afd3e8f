"""Damaged and lying files end in a refusal, never in a hang or a wrong picture."""

import csv
import struct
import zlib
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import PIL.Image
import pytest

from tests.whole_pictures import encode_exr
from tests.worker.images.exr_bytes import exr_header
from tests.worker.images.measuring_child import MeasuringChild
from worker.images.image import Image

PICTURE_FOLDERS = (
    "exr_damaged",
    "exr_openexrtest",
    "oiio",
    "pillow",
    "png_crashers",
    "png_pngsuite_corrupt",
)
CODES = {"asset_unusable", "asset_unsupported", "asset_too_large"}
MODEST_BYTES = 400 * 2**20  # an idle child with its decoders loaded has 60 MB


@pytest.mark.corpus
@pytest.mark.parametrize("folder", PICTURE_FOLDERS)
def test_damaged_pictures_are_accepted_or_refused_and_kill_nothing(
    corpus: Path, child: MeasuringChild, folder: str
) -> None:
    files = sorted(path for path in (corpus / "4_hostile" / folder).rglob("*") if path.is_file())

    answers = {path.name: child.measure(path) for path in files}

    assert len(answers) >= 8
    assert {name: answer for name, answer in answers.items() if "death" in answer} == {}
    codes = {answer["failure"]["code"] for answer in answers.values() if "failure" in answer}
    assert codes <= CODES
    assert max(answer["peak_bytes"] for answer in answers.values()) < MODEST_BYTES


@pytest.mark.corpus
def test_what_every_independent_reader_refuses_is_refused(
    corpus: Path, child: MeasuringChild
) -> None:
    with (corpus / "4_hostile" / "FACTS_independent_readers.csv").open() as table:
        rows = list(csv.DictReader(table))
    verdicts = {row.pop("file"): {said for said in row.values() if said} for row in rows}
    # A .gltf is no picture, and is usable once the damaged picture beside it is replaced.
    refused = [
        name for name, said in verdicts.items() if said == {"reject"} and not name.endswith(".gltf")
    ]

    accepted = [name for name in refused if "facts" in child.measure(corpus / "4_hostile" / name)]

    assert len(refused) >= 50
    assert accepted == []


@pytest.mark.corpus
def test_pngsuite_corrupt_files_are_all_refused(corpus: Path, child: MeasuringChild) -> None:
    for path in sorted((corpus / "4_hostile" / "png_pngsuite_corrupt").glob("*.png")):
        assert "failure" in child.measure(path), path.name


def ihdr(width: int, height: int, bits: int = 8, colour: int = 6, interlace: int = 0) -> bytes:
    return struct.pack(">IIBBBBB", width, height, bits, colour, 0, 0, interlace)


def test_png_pixel_bombs_are_refused_from_the_header(
    child: MeasuringChild, png_file: Callable[..., Path]
) -> None:
    rows = zlib.compress(bytes(64 * 120001), 9)
    for side, code in ((30000, "asset_too_large"), (2**31 - 1, "asset_unusable")):
        bomb = png_file(("IHDR", ihdr(side, side)), ("IDAT", rows), ("IEND", b""))
        child.fresh()

        answer = child.measure(bomb)

        assert answer["failure"]["code"] in {code, "asset_too_large"}
        assert answer["peak_bytes"] < MODEST_BYTES


def test_a_refused_size_says_the_size_and_the_bounds(
    child: MeasuringChild, png_file: Callable[..., Path]
) -> None:
    wide = png_file(("IHDR", ihdr(16385, 1)), ("IDAT", b""), ("IEND", b""))
    assert child.measure(wide)["failure"] == {
        "code": "asset_too_large",
        "message": "the picture has 16385 x 1 texels; the most is 16384 a side and 67108864 in all",
        "pointer": None,
    }
    large = png_file(("IHDR", ihdr(16384, 4097, colour=0)), ("IDAT", b""), ("IEND", b""))
    message = child.measure(large)["failure"]["message"]
    assert message.startswith("the picture has 16384 x 4097 texels; the most is ")


def test_a_text_chunk_that_inflates_to_a_quarter_gigabyte_costs_no_memory(
    child: MeasuringChild, png_file: Callable[..., Path]
) -> None:
    squeeze = zlib.compressobj(9)
    text = b"".join(squeeze.compress(bytes(2**24)) for _ in range(16)) + squeeze.flush()
    for name, head in (("zTXt", b"k\0\0"), ("iCCP", b"k\0\0"), ("iTXt", b"k\0\1\0\0\0")):
        bomb = png_file(
            ("IHDR", ihdr(1, 1, colour=0)),
            (name, head + text),
            ("IDAT", zlib.compress(b"\0\x80")),
            ("IEND", b""),
        )
        child.fresh()

        answer = child.measure(bomb)

        assert "death" not in answer
        assert answer["peak_bytes"] < MODEST_BYTES


@pytest.mark.parametrize(
    ("attributes", "code"),
    [
        ({"dataWindow": (0, 0, 2**30, 2**30)}, "asset_too_large"),  # EXR-1
        ({"displayWindow": (0, 0, 2**30, 2**30)}, "asset_too_large"),
        ({"dataWindow": (5, 5, 4, 4)}, "asset_unusable"),  # EXR-2
        ({"dataWindow": (0, 0, 2**20, 2**20), "tiles": (1, 1)}, "asset_too_large"),  # EXR-3
        ({"dataWindow": (-(2**31), 0, 2**31 - 1, 0)}, "asset_unusable"),
    ],
)
def test_exr_windows_that_lie_are_refused(
    child: MeasuringChild, tmp_path: Path, attributes: dict[str, Any], code: str
) -> None:
    bomb = tmp_path / "bomb.exr"
    bomb.write_bytes(exr_header(**attributes) + bytes(100))
    child.fresh()

    answer = child.measure(bomb)

    assert answer["failure"]["code"] in {code, "asset_unusable"}
    assert answer["peak_bytes"] < MODEST_BYTES


def test_an_exr_of_4096_large_parts_is_refused(child: MeasuringChild, tmp_path: Path) -> None:
    bomb = tmp_path / "parts.exr"
    parts = [
        exr_header(
            part_name=f"p{n}", dataWindow=(0, 0, 4095, 4095), displayWindow=(0, 0, 4095, 4095)
        )
        for n in range(4096)
    ]
    bomb.write_bytes(parts[0][:4] + struct.pack("<I", 2 | 0x1000))
    with bomb.open("ab") as file:
        file.write(b"".join(part[8:] for part in parts) + b"\0" + bytes(64))
    child.fresh()

    answer = child.measure(bomb)

    assert answer["failure"]["code"] in CODES
    assert answer["peak_bytes"] < MODEST_BYTES


def test_radiance_bombs_are_refused(child: MeasuringChild, tmp_path: Path) -> None:
    bomb = tmp_path / "bomb.hdr"
    for size in ("-Y 60000 +X 60000", "-Y 2147483647 +X 1", "-Y 0 +X 5", "-Y -3 +X 5"):
        bomb.write_bytes(f"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n{size}\n".encode() + bytes(10))

        answer = child.measure(bomb)

        assert answer["failure"]["code"] in CODES, size


def test_a_progressive_jpeg_bomb_is_refused_from_the_header(
    child: MeasuringChild, tmp_path: Path
) -> None:
    small = tmp_path / "small.jpg"
    PIL.Image.new("RGB", (16, 16)).save(small, progressive=True)
    content = bytearray(small.read_bytes())
    frame = content.index(b"\xff\xc2")
    content[frame + 5 : frame + 9] = struct.pack(">HH", 65500, 65500)
    bomb = tmp_path / "bomb.jpg"
    bomb.write_bytes(content)
    child.fresh()

    answer = child.measure(bomb)

    assert answer["failure"]["code"] == "asset_too_large"
    assert answer["peak_bytes"] < MODEST_BYTES


def picture_files(folder: Path) -> list[Path]:
    """One noisy picture in every format, larger than any header."""
    codes = np.random.default_rng(11).integers(0, 256, (40, 50, 3), np.uint8)
    picture = PIL.Image.fromarray(codes)
    paths = [folder / name for name in ("a.png", "a.jpg", "a.tif", "b.tif", "a.exr", "a.hdr")]
    picture.save(paths[0])
    picture.save(paths[1], quality=95)
    picture.save(paths[2])
    picture.save(paths[3], compression="tiff_lzw")
    light = Image(codes.astype(np.float32) / 255, "colour")
    encode_exr({"": light}, paths[4], pixel_type="half", digest="", version="")
    rgbe = np.concatenate([codes, np.full((40, 50, 1), 128, np.uint8)], axis=2)
    paths[5].write_bytes(b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 40 +X 50\n" + rgbe.tobytes())
    return paths


def test_whole_pictures_are_accepted_and_cut_ones_refused(
    child: MeasuringChild, tmp_path: Path
) -> None:
    for path in picture_files(tmp_path):
        facts = child.measure(path)["facts"]
        assert (facts["width"], facts["height"], facts["channels"]) == (50, 40, 3)
        content = path.read_bytes()
        cut = tmp_path / "cut"
        for length in (len(content) - 1, len(content) - 60, len(content) // 2, 40, 3, 0):
            cut.write_bytes(content[:length])

            answer = child.measure(cut)

            harmless = path.name == "a.tif" and length == len(content) - 1
            assert "failure" in answer or harmless, (path.name, length, answer)


def test_flipped_bits_kill_nothing(child: MeasuringChild, tmp_path: Path) -> None:
    chance = np.random.default_rng(23)
    damaged = tmp_path / "damaged"
    for path in picture_files(tmp_path):
        content = np.frombuffer(path.read_bytes(), np.uint8)
        for _ in range(60):
            hurt = content.copy()
            reach = len(hurt) if chance.random() < 0.5 else 400  # half of the time the header
            places = chance.integers(4, reach, chance.integers(1, 6))
            hurt[places] = chance.integers(0, 256, len(places))
            damaged.write_bytes(hurt.tobytes())

            answer = child.measure(damaged)

            assert "death" not in answer, (path.name, places)
