"""Models made on the spot: a square of two triangles in every kind of file that is taken."""

import base64
import json
import struct
from typing import Any

CORNERS = [(-1.0, -1.0, 0.0), (1.0, -1.0, 0.0), (1.0, 1.0, 0.0), (-1.0, 1.0, 0.0)]
TRIANGLES = [(0, 1, 2), (0, 2, 3)]

BINARY = b"".join(struct.pack("<3f", *corner) for corner in CORNERS) + b"".join(
    struct.pack("<3H", *triangle) for triangle in TRIANGLES
)
POSITIONS_BYTES = 48

OBJ = (
    b"mtllib square.mtl\nusemtl red\n"
    + b"".join(b"v %g %g %g\n" % corner for corner in CORNERS)
    + b"".join(b"f %d %d %d\n" % tuple(index + 1 for index in triangle) for triangle in TRIANGLES)
)
MTL = b"newmtl red\nKd 1 0 0\n"
STL = (
    bytes(80)
    + struct.pack("<I", len(TRIANGLES))
    + b"".join(
        struct.pack("<3f", 0, 0, 1)
        + b"".join(struct.pack("<3f", *CORNERS[index]) for index in triangle)
        + b"\0\0"
        for triangle in TRIANGLES
    )
)
PLY = (
    b"ply\nformat ascii 1.0\nelement vertex 4\n"
    b"property float x\nproperty float y\nproperty float z\n"
    b"element face 2\nproperty list uchar int vertex_indices\nend_header\n"
    + b"".join(b"%g %g %g\n" % corner for corner in CORNERS)
    + b"".join(b"3 %d %d %d\n" % triangle for triangle in TRIANGLES)
)


def document(**changes: Any) -> dict[str, Any]:
    """The square as glTF, red and double-sided, without light of its own."""
    views = [(0, POSITIONS_BYTES), (POSITIONS_BYTES, len(BINARY) - POSITIONS_BYTES)]
    return {
        "asset": {"version": "2.0"},
        "scene": 0,
        "scenes": [{"nodes": [0]}],
        "nodes": [{"name": "square", "mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1, "material": 0}]}],
        "materials": [
            {
                "name": "red",
                "pbrMetallicRoughness": {"baseColorFactor": [1, 0, 0, 1]},
                "extensions": {"KHR_materials_unlit": {}},
            }
        ],
        "extensionsUsed": ["KHR_materials_unlit"],
        "accessors": [
            {
                "bufferView": 0,
                "componentType": 5126,
                "count": len(CORNERS),
                "type": "VEC3",
                "min": [-1, -1, 0],
                "max": [1, 1, 0],
            },
            {"bufferView": 1, "componentType": 5123, "count": 6, "type": "SCALAR"},
        ],
        "bufferViews": [
            {"buffer": 0, "byteOffset": start, "byteLength": length} for start, length in views
        ],
        "buffers": [{"byteLength": len(BINARY)}],
        **changes,
    }


def packed(content: dict[str, Any], binary: bytes) -> bytes:
    """A glTF document and its first buffer as one binary file."""

    def chunk(kind: bytes, content: bytes, filler: bytes) -> bytes:
        content += filler * (-len(content) % 4)
        return struct.pack("<I", len(content)) + kind + content

    text = json.dumps(content).encode()
    chunks = chunk(b"JSON", text, b" ") + chunk(b"BIN\0", binary, b"\0")
    return b"glTF" + struct.pack("<II", 2, 12 + len(chunks)) + chunks


def glb(**changes: Any) -> bytes:
    """The square as one binary file."""
    return packed(document(**changes), BINARY)


def gltf(uri: str | None = None, **changes: Any) -> bytes:
    """The square as text, with its buffer inside or, where a URI is given, beside it."""
    inside = "data:application/gltf-buffer;base64," + base64.b64encode(BINARY).decode()
    buffers = [{"byteLength": len(BINARY), "uri": inside if uri is None else uri}]
    return json.dumps(document(**{"buffers": buffers, **changes})).encode()
