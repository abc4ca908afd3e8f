"""OpenEXR files by hand: an independent reader and writer of their simplest kind.

Source: "OpenEXR File Layout" and "Technical Introduction to OpenEXR" (Kainz, Bogart and Stanczyk).
"""

import struct
import zlib
from dataclasses import dataclass
from typing import Any

import numpy as np

MAGIC = b"\x76\x2f\x31\x01"
TYPES = {1: np.dtype("<f2"), 2: np.dtype("<f4")}


def exr_header(
    *,
    dataWindow: tuple[int, int, int, int] = (0, 0, 3, 3),  # noqa: N803
    displayWindow: tuple[int, int, int, int] = (0, 0, 3, 3),  # noqa: N803
    channels: tuple[tuple[str, int], ...] = (("B", 1), ("G", 1), ("R", 1)),
    tiles: tuple[int, int] | None = None,
    part_name: str = "",
    version_flags: int = 0,
) -> bytes:
    """Give magic, version and attributes of a file with ZIP compression."""
    channel_list = b"".join(
        name.encode() + b"\0" + struct.pack("<iBxxxii", kind, 0, 1, 1) for name, kind in channels
    )
    attributes = [
        ("channels", "chlist", channel_list + b"\0"),
        ("compression", "compression", b"\x03"),
        ("dataWindow", "box2i", struct.pack("<4i", *dataWindow)),
        ("displayWindow", "box2i", struct.pack("<4i", *displayWindow)),
        ("lineOrder", "lineOrder", b"\0"),
        ("pixelAspectRatio", "float", struct.pack("<f", 1)),
        ("screenWindowCenter", "v2f", bytes(8)),
        ("screenWindowWidth", "float", struct.pack("<f", 1)),
    ]
    if tiles:
        attributes.append(("tiles", "tiledesc", struct.pack("<IIB", *tiles, 0)))
        version_flags |= 0x200
    if part_name:
        attributes += [
            ("name", "string", part_name.encode()),
            ("type", "string", b"scanlineimage"),
            ("chunkCount", "int", struct.pack("<i", (dataWindow[3] - dataWindow[1]) // 16 + 1)),
        ]
    body = b"".join(
        name.encode() + b"\0" + kind.encode() + b"\0" + struct.pack("<i", len(data)) + data
        for name, kind, data in attributes
    )
    return MAGIC + struct.pack("<I", 2 | version_flags) + body + b"\0"


@dataclass(frozen=True)
class ExrFile:
    attributes: dict[str, tuple[str, bytes]]
    channels: dict[str, np.ndarray]


def parse_exr(content: bytes) -> ExrFile:
    """Read a single-part scanline file with ZIP compression and half and float channels."""
    assert content[:4] == MAGIC
    place = 8
    attributes: dict[str, tuple[str, bytes]] = {}
    while content[place]:
        name, kind, rest = content[place:].split(b"\0", 2)
        (size,) = struct.unpack_from("<i", rest)
        attributes[name.decode()] = (kind.decode(), rest[4 : 4 + size])
        place += len(name) + len(kind) + 2 + 4 + size
    place += 1
    left, top, right, bottom = struct.unpack("<4i", attributes["dataWindow"][1])
    assert attributes["compression"][1] == b"\x03"
    width, height = right - left + 1, bottom - top + 1
    listed = list(channel_types(attributes["channels"][1]))
    planes: dict[str, Any] = {name: np.zeros((height, width), kind) for name, kind in listed}
    offsets = struct.unpack_from(f"<{-(-height // 16)}Q", content, place)
    for offset in offsets:
        line, size = struct.unpack_from("<ii", content, offset)
        rows = min(16, height - (line - top))
        raw_size = rows * width * sum(kind.itemsize for _, kind in listed)
        raw = unpack_zip(content[offset + 8 : offset + 8 + size], raw_size)
        position = 0
        for row in range(line - top, line - top + rows):
            for name, kind in listed:
                planes[name][row] = np.frombuffer(raw, kind, width, position)
                position += width * kind.itemsize
    return ExrFile(attributes, planes)


def channel_types(listed: bytes) -> list[tuple[str, np.dtype[Any]]]:
    found = []
    while listed != b"\0":
        name, listed = listed.split(b"\0", 1)
        found.append((name.decode(), TYPES[struct.unpack_from("<i", listed)[0]]))
        listed = listed[16:]
    return found


def unpack_zip(packed: bytes, raw_size: int) -> bytes:
    """Inflate, undo the byte differences, interleave the halves; incompressible data is bare."""
    if len(packed) == raw_size:
        return packed
    steps = np.frombuffer(zlib.decompress(packed), np.uint8).astype(np.int64)
    steps[1:] -= 128
    straight = np.cumsum(steps).astype(np.uint8)
    half = (len(straight) + 1) // 2
    raw = np.empty_like(straight)
    raw[0::2], raw[1::2] = straight[:half], straight[half:]
    return raw.tobytes()
