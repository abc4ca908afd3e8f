"""The executor that looks at an uploaded file: is it usable, and what is it.

A light sibling of the executor of jobs, with the same two functions, for a child of its own.
"""

from pathlib import Path
from typing import Any

from worker.errors import AssetMissingError, UnusableAssetError
from worker.images import image_io
from worker.images.file_kinds import is_picture
from worker.measure_model import BUFFER_TYPE, buffer_facts, measure_model
from worker.models import formats as models
from worker.stages import Report


def warm(report: Report) -> dict[str, Any]:
    """Load the decoders and compile the readers of models."""
    report(0.0, "readers")
    models.warm()
    report(1.0, "ready")
    return {"fingerprint": image_io.version()}


def run(request: dict[str, Any], out: Path, report: Report) -> dict[str, Any]:
    """Decode and measure the file at `request["path"]`; nothing is written to `out`.

    `request["media_type"]` is what its uploader calls it. It counts only where the content does not
    tell: for the buffers of glTF, and for material libraries without materials.

    Returns:
        The facts, JSON-able: one of `api_schemas.assets` without its hash and length.

    Raises:
        AssetMissingError: There is no such file.
        UnusableAssetError: `asset_unsupported`, `asset_too_large` or `asset_unusable`.
    """
    report(0.0, "measure")
    path = Path(request["path"])
    if not path.is_file():
        raise AssetMissingError("the asset is not stored")
    media_type = request.get("media_type", "")
    if media_type == BUFFER_TYPE:
        return buffer_facts()
    if path.stat().st_size == 0:
        raise UnusableAssetError("the file is empty")
    if is_picture(path):
        return dict(image_io.measure(path))
    facts = measure_model(path.read_bytes(), media_type)
    if facts is None:
        raise UnusableAssetError(
            "the file is none of png, openexr, jpeg, tiff, hdr, gltf, glb, obj, mtl, ply, stl",
            code="asset_unsupported",
        )
    return facts
