"""Makes a picture file of one pixel at once, or does what the seed of a texture asks for.

Seed 1001 fails, 1002 takes a long time, 1003 dies, 1004 takes a little, 1005 goes through stages,
1006 is not sure how far it is, and 1007 takes a few seconds.
"""

import hashlib
import os
import struct
import time
import zlib

SECONDS = {1002: 60.0, 1004: 0.3, 1007: 4.0}


def warm(report):
    return {"fingerprint": "toy"}


def run(request, out, report):
    texture = request["body"].get("texture", {})
    seed = texture.get("seed")
    report(0.5, "make")
    if seed == 1001:
        raise ToyError
    if seed == 1003:
        os._exit(3)
    if seed in (1005, 1006):
        for step in range(24):
            share = (step + 1) / 25 if seed == 1005 else (step % 7) / 7
            report(share, "draw" if step < 18 else "encode")
            time.sleep(0.05)
    time.sleep(SECONDS.get(seed, 0))
    width, height = request["body"]["output"]["size"]
    exr = request["body"]["output"]["format"] == "exr"
    content = b"\x76\x2f\x31\x01 not a real one" if exr else png()
    out.write_bytes(content)
    return {
        "media_type": "image/x-exr" if exr else "image/png",
        "bytes": len(content),
        "sha256": hashlib.sha256(content).hexdigest(),
        "width": width,
        "height": height,
        "timings": {"make": 0.5},
        "counts": {"pixels": width * height},
        "digest": request["digest"],
    }


class ToyError(Exception):
    def as_failure(self):
        return {"code": "render_failed", "message": "the toy broke", "pointer": "/texture/seed"}


def png():
    """A white pixel."""

    def chunk(kind, content):
        checksum = zlib.crc32(kind + content)
        return struct.pack(">I", len(content)) + kind + content + struct.pack(">I", checksum)

    header = struct.pack(">IIBBBBB", 1, 1, 8, 0, 0, 0, 0)
    return (
        b"\x89PNG\r\n\x1a\n"
        + chunk(b"IHDR", header)
        + chunk(b"IDAT", zlib.compress(b"\0\xff"))
        + chunk(b"IEND", b"")
    )
