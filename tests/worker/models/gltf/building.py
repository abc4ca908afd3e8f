"""Small glTF files, made where they are tested."""

import base64
import json
import struct
import zlib
from typing import Any

import numpy as np

CODES = {"<i1": 5120, "<u1": 5121, "<i2": 5122, "<u2": 5123, "<u4": 5125, "<f4": 5126}
SHAPES = {(): "SCALAR", (2,): "VEC2", (3,): "VEC3", (4,): "VEC4", (4, 4): "MAT4"}
TRIANGLE = [[0, 0, 0], [1, 0, 0], [0, 1, 0]]


class Builder:
    """A document that grows; `json` may be changed at will before it is written."""

    def __init__(self, **members: Any) -> None:
        self.binary = bytearray()
        self.json: dict[str, Any] = {"asset": {"version": "2.0"}, **members}

    def add(self, kind: str, item: dict[str, Any]) -> int:
        self.json.setdefault(kind, []).append(item)
        return len(self.json[kind]) - 1

    def view(self, content: bytes, **members: Any) -> int:
        self.binary += bytes(-len(self.binary) % 4)
        start = len(self.binary)
        self.binary += content
        item = {"buffer": 0, "byteOffset": start, "byteLength": len(content), **members}
        return self.add("bufferViews", item)

    def accessor(self, values: Any, dtype: str = "<f4", **members: Any) -> int:
        array = np.asarray(values, dtype)
        return self.add(
            "accessors",
            {
                "bufferView": self.view(array.tobytes()),
                "componentType": CODES[dtype],
                "count": len(array),
                "type": SHAPES[array.shape[1:]],
                **members,
            },
        )

    def mesh(
        self,
        positions: Any = TRIANGLE,
        indices: Any = None,
        attributes: dict[str, int] | None = None,
        **members: Any,
    ) -> int:
        """Add a mesh of one primitive; `members` are the primitive's."""
        primitive = {"attributes": {"POSITION": self.accessor(positions), **(attributes or {})}}
        if indices is not None:
            primitive["indices"] = self.accessor(indices, "<u2")
        return self.add("meshes", {"primitives": [{**primitive, **members}]})

    def node(self, **members: Any) -> int:
        return self.add("nodes", members)

    def _with_buffer(self, **members: Any) -> dict[str, Any]:
        if not self.binary:
            return self.json
        return {"buffers": [{"byteLength": len(self.binary), **members}], **self.json}

    def glb(self) -> bytes:
        text = json.dumps(self._with_buffer()).encode()
        return glb(text, bytes(self.binary) if self.binary else None)

    def gltf(self) -> bytes:
        return json.dumps(self._with_buffer(uri=data_uri(bytes(self.binary)))).encode()

    def separate(self, uri: str = "shape.bin") -> tuple[bytes, bytes]:
        """Write the JSON and the buffer beside it."""
        return json.dumps(self._with_buffer(uri=uri)).encode(), bytes(self.binary)


def shown(mesh: int, **members: Any) -> dict[str, Any]:
    """One node with a mesh."""
    return {"nodes": [{"mesh": mesh, **members}]}


def glb(text: bytes, binary: bytes | None = None) -> bytes:
    text += b" " * (-len(text) % 4)
    chunks = struct.pack("<I4s", len(text), b"JSON") + text
    if binary is not None:
        binary += bytes(-len(binary) % 4)
        chunks += struct.pack("<I4s", len(binary), b"BIN\0") + binary
    return struct.pack("<4sII", b"glTF", 2, 12 + len(chunks)) + chunks


def data_uri(content: bytes, media_type: str = "application/octet-stream") -> str:
    return f"data:{media_type};base64,{base64.b64encode(content).decode()}"


def png(*, alpha: bool = False, transparent: bool = False) -> bytes:
    """A white pixel, with an alpha channel, or with white declared transparent."""
    colour = 6 if alpha else 2
    row = b"\0" + b"\xff" * (4 if alpha else 3)
    return b"\x89PNG\r\n\x1a\n" + b"".join(
        struct.pack(">I", len(body)) + name + body + struct.pack(">I", zlib.crc32(name + body))
        for name, body in (
            (b"IHDR", struct.pack(">IIBBBBB", 1, 1, 8, colour, 0, 0, 0)),
            *([(b"tRNS", b"\0\xff" * 3)] if transparent else []),
            (b"IDAT", zlib.compress(row)),
            (b"IEND", b""),
        )
    )
