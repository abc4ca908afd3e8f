from pathlib import Path

import pytest

from worker.errors import UnusableAssetError
from worker.images.file_kinds import sniff

PNG_END = b"\0\0\0\0IEND\xae\x42\x60\x82"


@pytest.mark.parametrize(
    ("start", "format_name"),
    [
        (b"\x89PNG\r\n\x1a\n" + PNG_END, "png"),
        (b"\x76\x2f\x31\x01\x02\0\0\0", "openexr"),
        (b"\xff\xd8\xff\xe0\0\x10JFIF", "jpeg"),
        (b"II*\0\x08\0\0\0", "tiff"),
        (b"MM\0*\0\0\0\x08", "tiff"),
        (b"II+\0\x08\0\0\0", "tiff"),
        (b"#?RADIANCE\n", "hdr"),
        (b"#?RGBE\n", "hdr"),
    ],
)
def test_content_tells_the_kind_and_the_name_does_not(
    tmp_path: Path, start: bytes, format_name: str
) -> None:
    path = tmp_path / "holiday.bmp"
    path.write_bytes(start)

    assert sniff(path).format == format_name


@pytest.mark.parametrize(
    "start",
    [
        b"GIF89a",
        b"BM6\0",
        b"<svg xmlns='http://www.w3.org/2000/svg'/>",
        b"RIFF\0\0\0\0WEBPVP8 ",
        b"8BPS\0\x01",
        b"DDS |\0\0\0",
        b"SIMPLE  =                    T",
        b"\0\0\x02\0",
        b"%PDF-1.7",
        b" \x89PNG\r\n\x1a\n",
    ],
)
def test_any_other_kind_is_refused_whatever_its_name(tmp_path: Path, start: bytes) -> None:
    path = tmp_path / "picture.png"
    path.write_bytes(start)

    with pytest.raises(UnusableAssetError) as refusal:
        sniff(path)

    assert refusal.value.code == "asset_unsupported"
    assert refusal.value.message == "the file is none of png, openexr, jpeg, tiff, hdr"


def test_an_empty_file_and_a_png_without_its_end_are_unusable(tmp_path: Path) -> None:
    path = tmp_path / "picture"
    for content in (b"", b"\x89PNG\r\n\x1a\n" + PNG_END[:-1]):
        path.write_bytes(content)

        with pytest.raises(UnusableAssetError) as refusal:
            sniff(path)

        assert refusal.value.code == "asset_unusable"
