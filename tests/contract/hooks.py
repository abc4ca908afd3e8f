"""What schemathesis is told of this API: real files for uploads, and one check of our own."""

import json
import struct
import zlib
from pathlib import Path

import schemathesis
from hypothesis import strategies as st

from tests import small_models

DOCUMENT = (Path(__file__).parents[2] / "openapi.json").read_text("utf-8")
SHORTEST_SECRET = 8


def png(width: int, height: int, value: int) -> bytes:
    """A grey picture."""

    def chunk(kind: bytes, content: bytes) -> bytes:
        checksum = zlib.crc32(kind + content)
        return struct.pack(">I", len(content)) + kind + content + struct.pack(">I", checksum)

    rows = (b"\0" + bytes([value]) * width) * height
    header = struct.pack(">IIBBBBB", width, height, 8, 0, 0, 0, 0)
    parts = (chunk(b"IHDR", header), chunk(b"IDAT", zlib.compress(rows)), chunk(b"IEND", b""))
    return b"\x89PNG\r\n\x1a\n" + b"".join(parts)


def damaged(content: bytes) -> st.SearchStrategy[bytes]:
    """A file as it is, cut short, or with one byte changed."""
    places = st.integers(0, len(content) - 1)
    changed = st.builds(
        lambda place, byte: content[:place] + bytes([byte]) + content[place + 1 :],
        places,
        st.integers(0, 255),
    )
    return st.just(content) | st.builds(lambda end: content[:end], places) | changed


WHOLE = st.builds(png, st.integers(1, 9), st.integers(1, 9), st.integers(0, 255))
CUT = st.builds(lambda whole, end: whole[:end], WHOLE, st.integers(0, 60))
JUNK = st.builds(
    bytes.__add__,
    st.sampled_from([b"", b"\x89PNG\r\n\x1a\n", b"\x76\x2f\x31\x01", b"\xff\xd8\xff", b"II*\0"]),
    st.binary(max_size=200),
)
schemathesis.openapi.media_type("image/png", WHOLE | CUT)
for name in ("image/x-exr", "image/jpeg", "image/tiff", "image/vnd.radiance"):
    schemathesis.openapi.media_type(name, JUNK)
schemathesis.openapi.media_type("application/octet-stream", WHOLE | JUNK)
for name, content in {
    "model/gltf-binary": small_models.glb(),
    "model/gltf+json": small_models.gltf(),
    "model/obj": small_models.OBJ,
    "model/mtl": small_models.MTL,
    "model/ply": small_models.PLY,
    "model/stl": small_models.STL,
    "application/gltf-buffer": small_models.BINARY,
}.items():
    schemathesis.openapi.media_type(name, damaged(content))


@schemathesis.check
def nothing_is_repeated(_context, response, case) -> None:
    """A refusal holds no value of the body that was sent."""
    if response.status_code < 400:
        return
    for text in texts(case.body):
        repeated = len(text) >= SHORTEST_SECRET and json.dumps(text)[1:-1] in response.text
        assert not repeated or text in DOCUMENT, f"the answer repeats {text!r}"


def texts(value: object):
    """Every text in a body that is a value, not a key."""
    if isinstance(value, str):
        yield value
    elif isinstance(value, dict):
        for item in value.values():
            yield from texts(item)
    elif isinstance(value, list):
        for item in value:
            yield from texts(item)
