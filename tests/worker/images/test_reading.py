from pathlib import Path

import numpy as np
import OpenImageIO
import PIL.Image
import pytest

from tests.worker.images.exr_bytes import exr_header
from worker.errors import UnusableAssetError
from worker.images.image_io import measure, read


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
    assert (np.isnan(pixels).sum(), np.isinf(pixels).sum()) == (3 * (2 * 2**10 - 2), 3 * 2)


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
