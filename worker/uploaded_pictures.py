"""The pictures a request speaks of, uploaded or inside its models, read when they are needed."""

import tempfile
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

from api_schemas.families import Meaning
from api_schemas.textures.image import ImageSpec
from worker.errors import AssetMissingError
from worker.images import image_io
from worker.images.edges import with_whole_edges
from worker.images.image import Image

if TYPE_CHECKING:
    from worker.images.codes import Transfer


class UploadedPictures:
    """The pictures of one request, by the hash of their files."""

    def __init__(self, folder: Path) -> None:
        """Look for pictures in the folder of assets."""
        self._folder = folder
        self._embedded: dict[str, bytes] = {}

    def embed(self, pictures: Mapping[str, bytes]) -> None:
        """Take pictures that lie inside a model, as encoded files by their SHA-256."""
        self._embedded |= pictures

    def read(self, spec: ImageSpec, meaning: Meaning) -> Image:
        """Decode a picture in linear light at its own size.

        Raises:
            AssetMissingError: There is no such picture.
            UnusableAssetError: The file is damaged.
        """
        decoded = self._decoded(spec, meaning)
        if spec.edge_texels == "halved":
            return replace(decoded, pixels=with_whole_edges(decoded.pixels))
        return decoded

    def _decoded(self, spec: ImageSpec, meaning: Meaning) -> Image:
        transfer: Transfer = "srgb" if spec.encoding == "srgb" else "linear"
        use_alpha = spec.alpha == "use"
        if spec.asset in self._embedded:
            with tempfile.NamedTemporaryFile() as file:
                file.write(self._embedded[spec.asset])
                file.flush()
                return image_io.read(Path(file.name), transfer, meaning, alpha=use_alpha)
        path = self._folder / spec.asset[:2] / spec.asset
        if not path.is_file():
            raise AssetMissingError("the asset is not stored any more")
        return image_io.read(path, transfer, meaning, alpha=use_alpha)
