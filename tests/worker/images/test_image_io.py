import time
from pathlib import Path

import numpy as np
import OpenImageIO
import PIL.Image
import pytest

from tests.worker.images.exr_bytes import exr_header, parse_exr
from worker.errors import UnusableAssetError
from worker.images.exr_layers import PixelType
from worker.images.image import Image, Meaning
from worker.images.image_io import encode_exr, encode_png, measure, read


def write_exr(path: Path, image: Image, pixel_type: PixelType = "half") -> Path:
    encode_exr({"": image}, path, pixel_type=pixel_type, digest="ab12", version="1.2.3")
    return path


def noise(channels: int, meaning: Meaning = "colour", size: tuple[int, int] = (37, 53)) -> Image:
    pixels = np.random.default_rng(4).random((*size, channels), np.float32)
    if meaning == "colour" and channels in (2, 4):
        pixels[..., :-1] *= pixels[..., -1:]
    return Image(pixels, meaning)


@pytest.mark.parametrize("pixel_type", ["half", "float"])
def test_four_comes_back_as_four(tmp_path: Path, pixel_type: PixelType) -> None:
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
    assert measure(path)["not_numbers"] == 1


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


def test_what_is_not_finite_in_a_png_is_black_or_white(tmp_path: Path) -> None:
    image = Image(np.array([[[np.nan], [np.inf], [-np.inf]]], np.float32), "colour")

    encode_png(image, tmp_path / "odd", bits=8, transfer="srgb")

    assert read(tmp_path / "odd", "linear", "data").pixels[0, :, 0].tolist() == [0, 1, 0]


def test_a_folder_that_is_not_there_is_an_os_error(tmp_path: Path) -> None:
    with pytest.raises(OSError, match="cannot write"):
        encode_png(noise(3), tmp_path / "no" / "where", bits=8, transfer="srgb")
    with pytest.raises(OSError, match="cannot write"):
        write_exr(tmp_path / "no" / "where", noise(3))


def test_exif_orientation_is_applied(tmp_path: Path) -> None:
    path = tmp_path / "turned"
    codes = np.zeros((16, 32, 3), np.uint8)
    codes[:, 16:] = 255  # stored: right half white
    exif = PIL.Image.Exif()
    exif[274] = 6  # the first row is the right side: turn clockwise
    PIL.Image.fromarray(codes).save(path, format="jpeg", exif=exif, quality=95)

    facts = measure(path)
    pixels = read(path, "srgb", "colour").pixels

    assert (facts["width"], facts["height"], facts["format"]) == (16, 32, "jpeg")
    assert pixels.shape == (32, 16, 3)
    assert pixels[:12].max() < 0.1 < 0.9 < pixels[20:].min()  # white is now at the bottom


@pytest.mark.parametrize(("mode", "channels"), [("L", 1), ("LA", 2), ("RGB", 3), ("RGBA", 4)])
@pytest.mark.parametrize("compression", [None, "tiff_lzw", "tiff_adobe_deflate"])
def test_tiffs_of_an_independent_writer_have_its_pixels(
    tmp_path: Path, mode: str, channels: int, compression: str | None
) -> None:
    path = tmp_path / "tiff"
    codes = np.random.default_rng(9).integers(0, 256, (21, 30, channels), np.uint8)
    PIL.Image.fromarray(codes[..., 0] if channels == 1 else codes, mode=None).save(
        path, format="tiff", compression=compression
    )

    assert measure(path)["has_alpha"] is (channels in (2, 4))
    read_codes = read(path, "linear", "data").pixels * 255
    assert np.array_equal(np.rint(read_codes), codes)


def test_radiance_pixels_follow_the_published_formula(tmp_path: Path) -> None:
    path = tmp_path / "radiance"
    rgbe = np.random.default_rng(6).integers(1, 255, (9, 5, 4), np.uint8)  # too narrow for RLE
    path.write_bytes(b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 9 +X 5\n" + rgbe.tobytes())

    pixels = read(path, "linear", "colour").pixels

    # Ward 1991: mantissa times 2^(exponent - 128 - 8); some readers add half a step.
    scale = np.ldexp(1.0, rgbe[..., 3:].astype(int) - 136)
    expected = rgbe[..., :3] * scale
    assert (np.abs(pixels - expected) <= 0.5 * scale * 1.000001).all()


def uncompressed_exr(path: Path, value: float, **header: object) -> Path:
    """A 4 x 4 half RGB file in one ZIP chunk that did not shrink, R = G = B = value."""
    start = exr_header(**header)  # type: ignore[arg-type]
    texels = np.full(4 * 4 * 3, value, np.float16).tobytes()
    chunk = np.array([0, len(texels)], "<i4").tobytes() + texels
    path.write_bytes(start + np.array([len(start) + 8], "<u8").tobytes() + chunk)
    return path


def test_exr_texels_land_in_the_display_window(tmp_path: Path) -> None:
    path = uncompressed_exr(tmp_path / "padded", 2.0, displayWindow=(-1, 0, 5, 2))

    pixels = read(path, "linear", "colour").pixels

    assert pixels.shape == (3, 7, 3)
    assert (pixels[:, 1:5] == 2).all()
    assert (pixels[:, 0] == 0).all()
    assert (pixels[:, 5:] == 0).all()


@pytest.mark.parametrize(
    ("channels", "message"),
    [
        ((("N.X", 1), ("N.Y", 1), ("N.Z", 1)), "of its 3 channels none is named"),
        ((("B", 0), ("G", 0), ("R", 0)), "its numbers are none of"),
    ],
)
def test_an_exr_without_a_picture_is_refused_by_name(
    tmp_path: Path, channels: tuple[tuple[str, int], ...], message: str
) -> None:
    path = uncompressed_exr(tmp_path / "named", 1.0, channels=channels)

    with pytest.raises(UnusableAssetError, match=message) as refusal:
        measure(path)

    assert refusal.value.code == "asset_unsupported"


def test_a_deep_exr_is_refused_by_name(tmp_path: Path) -> None:
    spec = OpenImageIO.ImageSpec(2, 2, 4, "half")
    spec.deep = True
    path = tmp_path / "deep"
    file = OpenImageIO.ImageOutput.create("openexr")
    assert file is not None
    assert file.open(str(path), spec)
    samples = OpenImageIO.DeepData()
    samples.init(4, 4, tuple(OpenImageIO.TypeDesc("half") for _ in range(4)), spec.channelnames)
    assert file.write_deep_image(samples)
    file.close()

    with pytest.raises(UnusableAssetError, match="deep pictures") as refusal:
        measure(path)

    assert refusal.value.code == "asset_unsupported"


@pytest.mark.corpus
def test_every_half_value_is_read(corpus: Path) -> None:
    path = corpus / "5_reference" / "openexr" / "AllHalfValues.exr"

    pixels = read(path, "linear", "colour").pixels

    halves = np.unique(pixels[..., 0].astype(np.float16).view(np.uint16))
    finite = np.isfinite(pixels[..., 0]).sum()
    assert finite == 2**16 - 2 * 2**10  # all exponents but the one of NaN and infinity
    assert len(halves) >= finite
    facts = measure(path)
    assert (facts["not_numbers"], facts["infinities"]) == (3 * (2 * 2**10 - 2), 3 * 2)


@pytest.mark.corpus
def test_xyz_primaries_are_brought_to_rec709(corpus: Path) -> None:
    folder = corpus / "5_reference" / "openexr"

    rec709 = read(folder / "Chromaticities_Rec709.exr", "linear", "colour").pixels
    converted = read(folder / "Chromaticities_XYZ.exr", "linear", "colour").pixels
    numbers = read(folder / "Chromaticities_XYZ.exr", "linear", "data").pixels

    # Both files hold halves: 2^-11 of each XYZ value, at most 3.24 + 1.54 + .5 times.
    allowed = 5.3 * 2**-11 * np.abs(numbers).max(axis=2, keepdims=True) + 2**-11 * np.abs(rec709)
    assert (np.abs(converted - rec709) <= allowed + 1e-6).all()
    assert np.abs(numbers - rec709).max() > 0.1


@pytest.mark.corpus
def test_display_windows_show_what_their_readme_says(corpus: Path) -> None:
    folder = corpus / "5_reference" / "openexr"
    whole = read(folder / "DisplayWindow_t01.exr", "linear", "colour").pixels

    beside = read(folder / "DisplayWindow_t09.exr", "linear", "colour").pixels
    corner = read(folder / "DisplayWindow_t13.exr", "linear", "colour").pixels

    assert whole.shape == (300, 400, 3)
    assert (beside == 0).all()
    assert np.array_equal(corner[0, 0], whole[-1, -1])
    assert np.count_nonzero(corner.any(axis=2)) <= 1


@pytest.mark.corpus
def test_the_ordinary_pictures_of_the_corpus_are_all_accepted(corpus: Path) -> None:
    folders = ("2_envmaps", "3_textures", "5_reference")
    pictures = [
        path
        for folder in folders
        for path in sorted((corpus / folder).rglob("*"))
        if path.suffix in {".png", ".exr", ".jpg", ".tif", ".tx", ".hdr"}
        and "bumpslope" not in path.name  # six moments of a height, none of them a picture
    ]

    facts = {path.name: measure(path) for path in pictures}

    assert len(facts) >= 100
    assert {fact["format"] for fact in facts.values()} == {"png", "openexr", "jpeg", "tiff", "hdr"}
