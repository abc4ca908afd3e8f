"""The models a request speaks of, read once and kept for the requests that follow."""

from collections import OrderedDict
from pathlib import Path

from api_schemas.model_mesh import ModelMesh
from worker.errors import AssetMissingError
from worker.models.formats import read_model
from worker.models.model import Model
from worker.uploaded_pictures import UploadedPictures

MODEL_BYTES_MAX = 128 << 20
_Key = tuple[str, tuple[tuple[str, str], ...], int | None]
_kept: OrderedDict[_Key, Model] = OrderedDict()


class UploadedModels:
    """The models of one request."""

    def __init__(self, folder: Path, pictures: UploadedPictures) -> None:
        """Look for models in the folder of assets; `pictures` is given those inside them."""
        self._folder = folder
        self._pictures = pictures

    def read(self, mesh: ModelMesh) -> Model:
        """Decode a model with the files beside it, or find it decoded.

        Raises:
            AssetMissingError: A file is not stored, or not in the model's set
                (`asset_file_missing`).
            RenderError: It has no such scene (`model_part_unknown`).
            UnusableAssetError: A file is damaged, or asks for what there is not.
        """
        key = (mesh.asset, tuple(sorted(mesh.files.items())), mesh.scene)
        if key not in _kept:
            files = {name: self._bytes(asset) for name, asset in mesh.files.items()}
            _kept[key] = read_model(self._bytes(mesh.asset), files, mesh.scene)
        _kept.move_to_end(key)
        model = _kept[key]
        while len(_kept) > 1 and sum(kept.size_bytes for kept in _kept.values()) > MODEL_BYTES_MAX:
            _kept.popitem(last=False)
        self._pictures.embed(model.pictures)
        return model

    def _bytes(self, asset: str) -> bytes:
        path = self._folder / asset[:2] / asset
        if not path.is_file():
            raise AssetMissingError("the asset is not stored any more")
        return path.read_bytes()
