"""The uploaded pictures a request speaks of, read when they are needed."""

from pathlib import Path
from typing import TYPE_CHECKING

from api_schemas.families import Meaning
from api_schemas.feasibility import assets_in
from api_schemas.requests import Request
from api_schemas.textures.image import ImageSpec
from worker.errors import AssetMissingError
from worker.images import image_io
from worker.images.image import Image

if TYPE_CHECKING:
    from worker.images.codes import Transfer


class UploadedPictures:
    """The pictures of one request, by the hash of their files."""

    def __init__(self, folder: Path, request: Request) -> None:
        """Find every picture, and decode none.

        Raises:
            AssetMissingError: The request names a picture that is not in the folder.
        """
        self._folder = folder
        for pointer, asset in assets_in(request):
            if not self._path(asset).is_file():
                raise AssetMissingError("the asset is not stored any more", pointer)

    def read(self, spec: ImageSpec, meaning: Meaning) -> Image:
        """Decode a picture in linear light at its own size.

        Raises:
            UnusableAssetError: The file is damaged.
        """
        transfer: Transfer = "srgb" if spec.encoding == "srgb" else "linear"
        return image_io.read(self._path(spec.asset), transfer, meaning)

    def _path(self, asset: str) -> Path:
        return self._folder / asset[:2] / asset
