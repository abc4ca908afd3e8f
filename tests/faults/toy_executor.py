"""Answers with bytes that follow from the request alone, and takes as long as its size says.

It stands in for the worker where only the engine is tried: no library has to be loaded.
"""

import hashlib
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

Report = Callable[[float, str], None]
SECONDS_PER_PIXEL = 2e-7


def warm(report: Report) -> dict[str, Any]:
    """There is nothing to warm up."""
    report(1.0, "ready")
    return {"fingerprint": "toy"}


def run(request: dict[str, Any], out: Path, report: Report) -> dict[str, Any]:
    """Write as many bytes as there are pixels, piece by piece."""
    width, height = request["body"]["output"]["size"]
    piece = request["digest"].encode() * 64
    pieces = 1 + width * height // len(piece)
    sha256 = hashlib.sha256()
    with out.open("wb") as file:
        for number in range(pieces):
            time.sleep(len(piece) * SECONDS_PER_PIXEL)
            report(number / pieces, "write")
            file.write(piece)
            sha256.update(piece)
    return {
        "media_type": "image/png",
        "bytes": out.stat().st_size,
        "sha256": sha256.hexdigest(),
        "width": width,
        "height": height,
        "timings": {},
        "counts": {},
        "warnings": [],
    }
