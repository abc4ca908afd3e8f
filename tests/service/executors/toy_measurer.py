"""Takes what begins like a PNG, what is called a buffer, and `toy ` with the facts to be told."""

import json
from pathlib import Path


def warm(report):
    return {"fingerprint": "toy"}


def run(request, out, report):
    content = Path(request["path"]).read_bytes()
    if request["media_type"] == "application/gltf-buffer":
        return {"kind": "buffer", "media_type": "application/gltf-buffer", "format": "bin"}
    if content.startswith(b"toy "):
        return json.loads(content[4:])
    if not content.startswith(b"\x89PNG"):
        raise NotAPictureError
    return {
        "kind": "image",
        "width": 1,
        "height": 1,
        "channels": 1,
        "bits": 8,
        "float": False,
        "format": "png",
        "media_type": "image/png",
        "has_alpha": False,
    }


class NotAPictureError(Exception):
    def as_failure(self):
        return {"code": "asset_unsupported", "message": "not a picture", "pointer": None}
