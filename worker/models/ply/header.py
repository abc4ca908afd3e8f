"""The header of a PLY file: which elements follow, and of what numbers.

Source: Turk, The PLY Polygon File Format, 1994.
"""

from dataclasses import dataclass
from typing import Literal

import numpy as np

from worker.errors import UnusableAssetError

Encoding = Literal["ascii", "binary_little_endian", "binary_big_endian"]

_LENGTH_MAX = 1 << 16
_ELEMENTS_MAX = 64
_PROPERTIES_MAX = 256

_TYPES = {
    "char": "i1",
    "int8": "i1",
    "uchar": "u1",
    "uint8": "u1",
    "short": "i2",
    "int16": "i2",
    "ushort": "u2",
    "uint16": "u2",
    "int": "i4",
    "int32": "i4",
    "uint": "u4",
    "uint32": "u4",
    "float": "f4",
    "float32": "f4",
    "double": "f8",
    "float64": "f8",
}


@dataclass(frozen=True, slots=True)
class Property:
    """One number of each row, or a list of them.

    Attributes:
        name: As written.
        type: Of the number or of the list's items, in the byte order of the file.
        count: The type of the length in front of a list; None where there is one number.
    """

    name: str
    type: np.dtype[np.generic]
    count: np.dtype[np.generic] | None = None


@dataclass(frozen=True, slots=True)
class Element:
    """Rows of the same properties."""

    name: str
    rows: int
    properties: tuple[Property, ...]

    @property
    def has_lists(self) -> bool:
        """Whether rows may differ in length."""
        return any(p.count is not None for p in self.properties)


@dataclass(frozen=True, slots=True)
class Header:
    """What is said before the numbers.

    Attributes:
        encoding: Of the numbers.
        elements: In the order of the file.
        texture: The picture that MeshLab names in a comment, or nothing.
        length: Bytes up to the numbers.
    """

    encoding: Encoding
    elements: tuple[Element, ...]
    texture: str
    length: int


def is_ply(data: bytes) -> bool:
    """Whether a file begins with the word ply on a line of its own."""
    return data[:4] in (b"ply\n", b"ply\r") or data[:16].split(b"\n")[0].rstrip() == b"ply"


def read_header(data: bytes) -> Header:
    """Read everything up to the line end_header.

    Raises:
        UnusableAssetError: `asset_unusable`.
    """
    lines, length = _lines(data)
    encoding: Encoding | None = None
    elements: list[Element] = []
    texture = ""
    for number, line in enumerate(lines, start=1):
        words = line.split()
        match words:
            case ["ply"] if number == 1:
                pass
            case ["format", "ascii" | "binary_little_endian" | "binary_big_endian" as found, *_]:
                encoding = found
            case ["comment", "TextureFile", *_]:
                texture = line.split(None, 2)[2].strip() if len(words) > 2 else ""
            case [] | ["comment" | "obj_info", *_]:
                pass
            case ["element", name, count] if _is_count(count) and len(elements) < _ELEMENTS_MAX:
                elements.append(Element(name, int(count), ()))
            case ["property", "list", count, kind, name] if elements and encoding:
                elements[-1] = _with(elements[-1], name, kind, count, encoding)
            case ["property", kind, name] if elements and encoding:
                elements[-1] = _with(elements[-1], name, kind, None, encoding)
            case _:
                raise UnusableAssetError(f"line {number} of its header says nothing known")
    if encoding is None:
        raise UnusableAssetError("its header does not say the format of its numbers")
    return Header(encoding, tuple(elements), texture, length)


def _lines(data: bytes) -> tuple[list[str], int]:
    """Part the header's lines, ended by any of the three line ends, and find the numbers."""
    start = data[:_LENGTH_MAX]
    at = start.find(b"end_header")
    while at > 0 and start[at - 1 : at] not in (b"\n", b"\r"):
        at = start.find(b"end_header", at + 1)
    if at < 0:
        raise UnusableAssetError("its header has no end")
    end = at + len(b"end_header")
    while start[end : end + 1] in (b" ", b"\t"):
        end += 1
    if start[end : end + 2] == b"\r\n":
        end += 2
    elif start[end : end + 1] in (b"\n", b"\r"):
        end += 1
    elif end < len(data):
        raise UnusableAssetError("its header has no end")
    return start[:at].decode("latin-1").splitlines(), end


def _is_count(word: str) -> bool:
    return word.isascii() and word.isdigit() and len(word) < 16


def _with(element: Element, name: str, kind: str, count: str | None, encoding: Encoding) -> Element:
    is_known = kind in _TYPES and (count is None or _TYPES.get(count, "f")[0] != "f")
    if not is_known or len(element.properties) == _PROPERTIES_MAX:
        raise UnusableAssetError("a property in its header is of no known type")
    order = ">" if encoding == "binary_big_endian" else "<"
    added = Property(
        name,
        np.dtype(order + _TYPES[kind]),
        None if count is None else np.dtype(order + _TYPES[count]),
    )
    return Element(element.name, element.rows, (*element.properties, added))
