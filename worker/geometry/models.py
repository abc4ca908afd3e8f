"""Uploaded models of any format, told by their content."""

from collections.abc import Mapping

from worker.errors import UnusableAssetError
from worker.geometry.model import Model


def read_model(data: bytes, files: Mapping[str, bytes], scene: int | None = None) -> Model:
    """Read a model.

    Args:
        data: The file.
        files: The files it speaks of, by name.
        scene: Which of its scenes; its default one without.

    Raises:
        UnusableAssetError: `asset_unsupported`, `asset_unusable` or `asset_too_large`.
    """
    raise UnusableAssetError("no model format is known yet", code="asset_unsupported")
