"""What the first bytes of a picture file tell, and whether the file is there to its end."""

import struct
from dataclasses import dataclass
from typing import Final

_PNG: Final = b"\x89PNG\r\n\x1a\n"
_JPEG: Final = b"\xff\xd8\xff"
_OTHERS: Final = (
    (b"RIFF", "WebP"),
    (b"\xabKTX", "KTX"),
    (b"DDS ", "DDS"),
    (b"GIF8", "GIF"),
    (b"BM", "BMP"),
    (b"II*\0", "TIFF"),
    (b"MM\0*", "TIFF"),
    (b"\x76\x2f\x31\x01", "OpenEXR"),
    (b"#?", "Radiance"),
)
_JPEG_FRAMES: Final = frozenset(range(0xC0, 0xD0)) - {0xC4, 0xC8, 0xCC}
_JPEG_BARE: Final = frozenset({0x01, *range(0xD0, 0xD8)})
_IHDR_BYTES: Final = 33


@dataclass(frozen=True, slots=True)
class PictureFile:
    """A PNG or JPEG file's own account of itself."""

    media_type: str
    width: int
    height: int
    has_alpha: bool


class BrokenPictureError(ValueError):
    """A PNG or JPEG file is cut short or contradicts itself."""


def kind_of(content: bytes | memoryview) -> str:
    """Return the media type glTF allows, or a word for what it is instead."""
    if bytes(content[:8]) == _PNG:
        return "image/png"
    if bytes(content[:3]) == _JPEG:
        return "image/jpeg"
    start = bytes(content[:16])
    return next((word for magic, word in _OTHERS if start.startswith(magic)), "unknown")


def look_at(content: bytes | memoryview) -> PictureFile:
    """Read the header of a PNG or JPEG file.

    Raises:
        BrokenPictureError: It is none, or not there to its end.
    """
    return _png(content) if bytes(content[:8]) == _PNG else _jpeg(content)


def _png(content: bytes | memoryview) -> PictureFile:
    if len(content) < _IHDR_BYTES or bytes(content[12:16]) != b"IHDR":
        raise BrokenPictureError("the PNG ends within its header")
    width, height, _, colour = struct.unpack_from(">IIBB", content, 16)
    if not (0 < width < 2**31 and 0 < height < 2**31 and colour in (0, 2, 3, 4, 6)):
        raise BrokenPictureError("the PNG's header is invalid")
    has_alpha = colour in (4, 6)
    place = len(_PNG)
    while place + 12 <= len(content):
        length = int.from_bytes(content[place : place + 4], "big")
        kind = bytes(content[place + 4 : place + 8])
        place += 12 + length
        if kind == b"tRNS":
            has_alpha = True
        if kind == b"IEND" and place <= len(content):
            return PictureFile("image/png", width, height, has_alpha)
    raise BrokenPictureError("the PNG ends before its last chunk")


def _jpeg(content: bytes | memoryview) -> PictureFile:
    place = 2
    while place + 4 <= len(content):
        if content[place] != 0xFF:
            break
        marker = content[place + 1]
        if marker == 0xFF or marker in _JPEG_BARE:
            place += 1 if marker == 0xFF else 2
            continue
        length = int.from_bytes(content[place + 2 : place + 4], "big")
        if marker in _JPEG_FRAMES and length >= 8 and place + 9 <= len(content):
            height, width = struct.unpack_from(">HH", content, place + 5)
            if not width:
                break
            return PictureFile("image/jpeg", width, height, has_alpha=False)
        place += 2 + length
    raise BrokenPictureError("the JPEG has no valid header")
