"""Which kind of picture a file is: its first bytes tell, its name and claimed type do not."""

import mmap
from dataclasses import dataclass
from pathlib import Path

from worker.errors import UnusableAssetError


@dataclass(frozen=True, slots=True)
class FileKind:
    """An accepted kind of picture file.

    Attributes:
        format: Its name in asset facts.
        media_type: The type it is served as.
        suffix: The file name ending by which the decoder is chosen.
        magics: What such a file may begin with.
        trailer: What a complete file holds, where the decoder does not insist on it.
    """

    format: str
    media_type: str
    suffix: str
    magics: tuple[bytes, ...]
    trailer: bytes = b""


FILE_KINDS = (
    FileKind(
        "png",
        "image/png",
        ".png",
        (b"\x89PNG\r\n\x1a\n",),
        trailer=b"\x00\x00\x00\x00IEND\xae\x42\x60\x82",  # the last chunk with its checksum
    ),
    FileKind("openexr", "image/x-exr", ".exr", (b"\x76\x2f\x31\x01",)),
    FileKind("jpeg", "image/jpeg", ".jpg", (b"\xff\xd8\xff",)),
    # Classic and BigTIFF, little and big endian.
    FileKind("tiff", "image/tiff", ".tif", (b"II*\0", b"MM\0*", b"II+\0", b"MM\0+")),
    FileKind("hdr", "image/vnd.radiance", ".hdr", (b"#?RADIANCE", b"#?RGBE")),
)

_LONGEST_MAGIC = max(len(magic) for kind in FILE_KINDS for magic in kind.magics)


def is_picture(path: Path) -> bool:
    """Whether a file begins as one of the accepted kinds does."""
    with path.open("rb") as file:
        start = file.read(_LONGEST_MAGIC)
    return any(start.startswith(kind.magics) for kind in FILE_KINDS)


def sniff(path: Path) -> FileKind:
    """Tell the kind of a picture file from its content.

    Raises:
        UnusableAssetError: `asset_unsupported` for any other kind, `asset_unusable` for a file that
            is empty or lacks its end.
    """
    with path.open("rb") as file:
        start = file.read(_LONGEST_MAGIC)
        if not start:
            raise UnusableAssetError("the file is empty")
        for kind in FILE_KINDS:
            if start.startswith(kind.magics):
                with mmap.mmap(file.fileno(), 0, access=mmap.ACCESS_READ) as content:
                    if content.rfind(kind.trailer) < 0:
                        raise UnusableAssetError(f"the {kind.format} file is cut short")
                return kind
    known = ", ".join(kind.format for kind in FILE_KINDS)
    raise UnusableAssetError(f"the file is none of {known}", code="asset_unsupported")
