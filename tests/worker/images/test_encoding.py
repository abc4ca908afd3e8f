import errno
import itertools
import resource
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import PIL.Image
import pytest

from api_schemas.families import Meaning
from api_schemas.output import ExrType, PngBits
from tests.whole_pictures import encode_exr, encode_png
from tests.worker.images.exr_bytes import parse_exr
from worker.images.image import Image
from worker.images.image_io import measure, read, write_png
from worker.images.image_io import write_exr as write_exr_bands


def write_exr(path: Path, image: Image, pixel_type: ExrType = "half") -> Path:
    encode_exr({"": image}, path, pixel_type=pixel_type, digest="ab12", version="1.2.3")
    return path


def noise(channels: int, meaning: Meaning = "colour", size: tuple[int, int] = (37, 53)) -> Image:
    pixels = np.random.default_rng(4).random((*size, channels), np.float32)
    if meaning == "colour" and channels in (2, 4):
        pixels[..., :-1] *= pixels[..., -1:]
    return Image(pixels, meaning)


@pytest.mark.parametrize("pixel_type", ["half", "float"])
def test_four_comes_back_as_four(tmp_path: Path, pixel_type: ExrType) -> None:
    image = Image(np.full((16, 16, 4), (4, 4, 4, 1), np.float32), "colour")

    path = write_exr(tmp_path / "four", image, pixel_type)

    assert np.array_equal(read(path, "linear", "colour").pixels, image.pixels)
    assert (parse_exr(path.read_bytes()).channels["R"] == 4).all()


@pytest.mark.parametrize("channels", [1, 2, 3, 4])
@pytest.mark.parametrize("meaning", ["colour", "data"])
def test_a_float_exr_gives_back_every_bit(tmp_path: Path, channels: int, meaning: Meaning) -> None:
    image = noise(channels, meaning)
    image.pixels[0, 0] = [np.nan, np.inf, -1e30, 1e-40][:channels]

    path = write_exr(tmp_path / "bits", image, "float")
    back = read(path, "linear", meaning)

    assert back.meaning == meaning
    assert np.array_equal(back.pixels, image.pixels, equal_nan=True)


def test_a_half_exr_holds_the_nearest_halves_by_an_independent_reader(tmp_path: Path) -> None:
    image = noise(4)

    parsed = parse_exr(write_exr(tmp_path / "half", image).read_bytes())

    assert sorted(parsed.channels) == ["A", "B", "G", "R"]
    for index, name in enumerate("RGBA"):
        assert np.array_equal(parsed.channels[name], image.pixels[..., index].astype(np.float16))


def test_an_exr_says_what_made_it_and_in_which_colours(tmp_path: Path) -> None:
    attributes = parse_exr(write_exr(tmp_path / "said", noise(4)).read_bytes()).attributes

    assert attributes["texloom:digest"] == ("string", b"ab12")
    assert attributes["texloom:version"] == ("string", b"1.2.3")
    rec709 = [0.64, 0.33, 0.30, 0.60, 0.15, 0.06, 0.3127, 0.3290]
    kind, stored = attributes["chromaticities"]
    assert kind == "chromaticities"
    assert np.frombuffer(stored, "<f4") == pytest.approx(rec709, rel=1e-6)


def test_layers_lie_side_by_side_each_in_its_own_type(tmp_path: Path) -> None:
    depth = Image(np.full((37, 53, 1), 123456.7, np.float32), "data")
    normals = noise(3, "data")
    path = tmp_path / "layers"

    encode_exr(
        {"": noise(4), "Z": depth, "N": normals}, path, pixel_type="half", digest="", version=""
    )

    channels = parse_exr(path.read_bytes()).channels
    assert set(channels) == {"R", "G", "B", "A", "Z", "N.X", "N.Y", "N.Z"}
    assert channels["A"].dtype == np.float16
    assert (channels["Z"] == np.float32(123456.7)).all()
    assert np.array_equal(channels["N.Y"], normals.pixels[..., 1])
    assert measure(path)["channels"] == 4


def test_data_alone_is_float_where_colour_would_be_half(tmp_path: Path) -> None:
    ids = Image(np.full((4, 4, 1), 4097, np.float32), "data")

    encode_exr({"id": ids}, tmp_path / "ids", pixel_type="half", digest="", version="")

    assert (parse_exr((tmp_path / "ids").read_bytes()).channels["id"] == 4097).all()


def test_equal_pictures_give_equal_bytes_at_any_time(tmp_path: Path) -> None:
    def encode() -> list[bytes]:
        write_exr(tmp_path / "exr", noise(4))
        encode_png(noise(4), tmp_path / "png", bits=8, transfer="srgb")
        return [(tmp_path / name).read_bytes() for name in ("exr", "png")]

    before = encode()
    time.sleep(1.1)  # clocks in files count seconds

    assert encode() == before


def test_a_png_holds_straight_alpha_and_the_srgb_curve(tmp_path: Path) -> None:
    # Premultiplied (.25, .1, 0, .5) is straight (.5, .2, 0): 187.52, 123.6 of 255; alpha 127.5.
    path = tmp_path / "straight"
    image = Image(np.full((2, 2, 4), (0.25, 0.1, 0, 0.5), np.float32), "colour")

    encode_png(image, path, bits=8, transfer="srgb")

    with PIL.Image.open(path) as picture:
        assert picture.format == "PNG"
        assert picture.mode == "RGBA"
        assert picture.getpixel((1, 1)) == (188, 124, 0, 128)
    assert read(path, "srgb", "colour").pixels[0, 0] == pytest.approx([0.25, 0.1, 0, 0.5], abs=3e-3)


@pytest.mark.parametrize(("channels", "mode"), [(1, "L"), (2, "LA"), (3, "RGB"), (4, "RGBA")])
@pytest.mark.parametrize("meaning", ["colour", "data"])
def test_a_png_has_the_channels_of_the_picture(
    tmp_path: Path, channels: int, mode: str, meaning: Meaning
) -> None:
    path = tmp_path / "channels"

    encode_png(noise(channels, meaning), path, bits=8, transfer="linear")

    with PIL.Image.open(path) as picture:
        assert picture.mode == mode


def chunk_names(content: bytes) -> list[bytes]:
    names, place = [], 8
    while place < len(content):
        size = int.from_bytes(content[place : place + 4])
        names.append(content[place + 4 : place + 8])
        place += 12 + size
    return names


def test_only_light_says_its_curve(tmp_path: Path) -> None:
    path = tmp_path / "chunks"
    said = {}
    for meaning, transfer in (("colour", "srgb"), ("colour", "linear"), ("data", "linear")):
        encode_png(noise(3, meaning), path, bits=8, transfer=transfer)  # type: ignore[arg-type]
        said[meaning, transfer] = set(chunk_names(path.read_bytes())) & {b"sRGB", b"gAMA", b"tIME"}

    assert said["colour", "srgb"] == {b"sRGB", b"gAMA"}
    assert said["colour", "linear"] == {b"gAMA"}
    assert said["data", "linear"] == set()


def test_sixteen_bit_data_comes_back_within_half_a_code(tmp_path: Path) -> None:
    image = noise(4, "data")

    encode_png(image, tmp_path / "data", bits=16, transfer="linear")

    back = read(tmp_path / "data", "linear", "data").pixels
    assert np.abs(back - image.pixels).max() <= 0.5 / 65535 + 1e-7


@pytest.mark.parametrize("cuts", [(0, 37), (0, 1, 17, 18, 37)])
@pytest.mark.parametrize("bits", [8, 16])
def test_bands_of_a_png_make_the_same_bytes(
    tmp_path: Path, cuts: tuple[int, ...], bits: PngBits
) -> None:
    image = noise(4)
    bands = [Image(image.pixels[a:b], "colour") for a, b in itertools.pairwise(cuts)]
    how: Any = {"bits": bits, "transfer": "srgb", "exposure": 0.5, "tone_curve": "aces"}

    encode_png(image, tmp_path / "whole", **how)
    write_png(bands, 37, tmp_path / "cut", **how)

    assert (tmp_path / "cut").read_bytes() == (tmp_path / "whole").read_bytes()


@pytest.mark.parametrize("cuts", [(0, 37), (0, 1, 17, 18, 37)])
@pytest.mark.parametrize("pixel_type", ["half", "float"])
def test_bands_of_an_exr_make_the_same_bytes(
    tmp_path: Path, cuts: tuple[int, ...], pixel_type: ExrType
) -> None:
    layers = {"": noise(4), "N": noise(3, "data")}
    bands = [
        {name: Image(image.pixels[a:b], image.meaning) for name, image in layers.items()}
        for a, b in itertools.pairwise(cuts)
    ]
    how: Any = {"pixel_type": pixel_type, "digest": "ab12", "version": "1.2.3"}

    encode_exr(layers, tmp_path / "whole", **how)
    write_exr_bands(bands, 37, tmp_path / "cut", **how)

    assert (tmp_path / "cut").read_bytes() == (tmp_path / "whole").read_bytes()


def test_a_picture_that_cannot_be_finished_is_told_as_what_stopped_it(tmp_path: Path) -> None:
    def bands() -> Iterator[Image]:
        yield noise(4)
        raise ZeroDivisionError

    with pytest.raises(ZeroDivisionError):
        write_png(
            bands(),
            74,
            tmp_path / "half",
            bits=8,
            transfer="srgb",
            exposure=0.0,
            tone_curve="none",
        )


def test_what_is_not_finite_in_a_png_is_black_or_white(tmp_path: Path) -> None:
    image = Image(np.array([[[np.nan], [np.inf], [-np.inf]]], np.float32), "colour")

    encode_png(image, tmp_path / "odd", bits=8, transfer="srgb")

    assert read(tmp_path / "odd", "linear", "data").pixels[0, :, 0].tolist() == [0, 1, 0]


def test_a_folder_that_is_not_there_is_an_os_error(tmp_path: Path) -> None:
    with pytest.raises(OSError, match="cannot write"):
        encode_png(noise(3), tmp_path / "no" / "where", bits=8, transfer="srgb")
    with pytest.raises(OSError, match="cannot write"):
        write_exr(tmp_path / "no" / "where", noise(3))


@pytest.fixture
def small_files() -> Iterator[None]:
    """No file may be longer than 4 KiB, as on a disk that is full."""
    before = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (4096, before[1]))
    yield
    resource.setrlimit(resource.RLIMIT_FSIZE, before)


def test_a_full_disk_is_told_by_its_number(tmp_path: Path, small_files: None) -> None:
    image = noise(4, size=(200, 200))
    with pytest.raises(OSError, match="too large") as png:
        encode_png(image, tmp_path / "x.png", bits=8, transfer="srgb")
    with pytest.raises(OSError, match="too large") as exr:
        write_exr(tmp_path / "x.exr", image)

    assert (png.value.errno, exr.value.errno) == (errno.EFBIG, errno.EFBIG)
