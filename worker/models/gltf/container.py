"""The GLB container: a header, one chunk of JSON, perhaps one of binary data."""

import struct
from dataclasses import dataclass
from typing import Final

from worker.errors import UnusableAssetError

MAGIC: Final = b"glTF"
_HEADER: Final = struct.Struct("<4sII")
_CHUNK: Final = struct.Struct("<II")
_JSON: Final = 0x4E4F534A
_BINARY: Final = 0x004E4942


@dataclass(frozen=True, slots=True)
class Container:
    """What a file holds before it is understood.

    Attributes:
        text: The JSON, undecoded.
        binary: The binary chunk of a GLB, if it has one.
        warnings: What is odd about the container.
    """

    text: memoryview
    binary: memoryview | None = None
    warnings: tuple[str, ...] = ()


def open_container(data: bytes) -> Container:
    """Take a GLB apart; any other file is JSON as a whole.

    Raises:
        UnusableAssetError: Lengths, order or number of the chunks are wrong (`asset_unusable`), or
            the container has another version (`asset_unsupported`).
    """
    view = memoryview(data)
    return _open_glb(view) if data.startswith(MAGIC) else Container(view)


def _open_glb(view: memoryview) -> Container:
    if len(view) < _HEADER.size:
        raise UnusableAssetError("the GLB ends within its header")
    _, version, length = _HEADER.unpack_from(view)
    if version != 2:
        raise UnusableAssetError(f"GLB version {version} is not 2", code="asset_unsupported")
    if length > len(view):
        raise UnusableAssetError(f"the GLB has {len(view)} bytes and claims {length}")
    if length < _HEADER.size + _CHUNK.size:
        raise UnusableAssetError(f"the GLB claims {length} bytes, too few for a chunk")
    chunks: dict[int, memoryview] = {}
    place = _HEADER.size
    while place < length:
        kind, chunk = _chunk(view[:length], place)
        if place == _HEADER.size and kind != _JSON:
            raise UnusableAssetError("the first chunk of the GLB is not JSON")
        if kind in chunks:
            raise UnusableAssetError("the GLB has two chunks of one kind")
        if kind == _BINARY and len(chunks) != 1:
            raise UnusableAssetError("the binary chunk of the GLB is not its second one")
        chunks[kind] = chunk
        place += _CHUNK.size + len(chunk)
    warnings = []
    if len(view) > length:
        warnings.append(f"{len(view) - length} bytes after the end of the GLB are ignored")
    if chunks.keys() - {_JSON, _BINARY}:
        warnings.append("chunks of unknown kinds in the GLB are ignored")
    return Container(chunks[_JSON], chunks.get(_BINARY), tuple(warnings))


def _chunk(view: memoryview, place: int) -> tuple[int, memoryview]:
    start = place + _CHUNK.size
    if start > len(view):
        raise UnusableAssetError("the GLB ends within the header of a chunk")
    length, kind = _CHUNK.unpack_from(view, place)
    if length % 4:
        raise UnusableAssetError(f"a chunk of the GLB has {length} bytes, no multiple of 4")
    if start + length > len(view):
        raise UnusableAssetError(
            f"a chunk of the GLB claims {length} bytes where {len(view) - start} are left"
        )
    if kind == _JSON and not length:
        raise UnusableAssetError("the JSON chunk of the GLB is empty")
    return kind, view[start : start + length]
