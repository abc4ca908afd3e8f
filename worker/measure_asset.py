"""The executor that looks at an uploaded file: is it usable, and what is it.

A light sibling of the executor of jobs, with the same two functions, for a child of its own.
"""

from pathlib import Path
from typing import Any

from worker.errors import AssetMissingError
from worker.images import image_io
from worker.stages import Report


def warm(report: Report) -> dict[str, Any]:
    """Load the decoders."""
    report(1.0, "ready")
    return {"fingerprint": image_io.version()}


def run(request: dict[str, Any], out: Path, report: Report) -> dict[str, Any]:
    """Decode and measure the file at `request["path"]`; nothing is written to `out`.

    Returns:
        The facts, JSON-able: see `image_io.ImageFacts`.

    Raises:
        AssetMissingError: There is no such file.
        UnusableAssetError: `asset_unsupported`, `asset_too_large` or `asset_unusable`.
    """
    report(0.0, "measure")
    path = Path(request["path"])
    if not path.is_file():
        raise AssetMissingError("the asset is not stored")
    return dict(image_io.measure(path))
