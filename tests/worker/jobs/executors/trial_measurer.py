"""A measurer that crashes, hangs or refuses as the file's first bytes say."""

import ctypes
import time
from pathlib import Path


class UnusableError(Exception):
    def as_failure(self):
        return {"code": "asset_unusable", "message": "not a picture", "pointer": None}


def warm(report):
    return {}


def run(request, out, report):
    content = Path(request["path"]).read_bytes()
    if content == b"crash":
        ctypes.string_at(0)
    if content == b"hang":
        time.sleep(60)
    if content == b"refuse":
        raise UnusableError
    if content == b"called":
        return {"kind": request["media_type"]}
    if content == b"scratch":
        out.write_bytes(b"scratch")
    return {"kind": "image", "size": len(content)}
