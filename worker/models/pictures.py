"""The pictures in a model's set: what has to be known of them before they are drawn."""

import hashlib
import tempfile
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path

from api_schemas.families import Meaning
from api_schemas.textures.image import ImageSpec
from worker.images import image_io
from worker.images.file_kinds import FILE_KINDS
from worker.models.siblings import sibling

_GREY_SPREAD = 0.1  # more than the noise of a JPEG, less than the colours of a normal map
_GREY_SHARE = 0.99


class PictureSet:
    """The pictures among a model's files, by name; each is decoded once, if at all."""

    def __init__(self, files: Mapping[str, bytes]) -> None:
        self._files = files
        self._hashes: dict[str, str] = {}
        self._floats: dict[str, bool] = {}
        self._alphas: dict[str, bool] = {}
        self._greys: dict[str, bool] = {}
        self.used: dict[str, bytes] = {}

    def spec(self, name: str, meaning: Meaning) -> ImageSpec:
        """Name a picture by its hash, and say how its numbers are read.

        Pictures of 8 and 16 bits are sRGB in the place of a colour, as uploads are; their alpha has
        no meaning there.

        Raises:
            AssetMissingError: `asset_file_missing`.
            UnusableAssetError: It is no picture, or damaged; or its name cannot be one.
        """
        content = sibling(self._files, name)
        if name not in self._hashes:
            self._hashes[name] = hashlib.sha256(content).hexdigest()
        if meaning == "colour" and name not in self._floats:
            self._floats[name] = _holds_floats(content)
        self.used[self._hashes[name]] = content
        is_srgb = meaning == "colour" and not self._floats[name]
        return ImageSpec(
            technique="image",
            asset=self._hashes[name],
            encoding="srgb" if is_srgb else "linear",
            alpha="ignore" if meaning == "colour" else "use",
        )

    def has_alpha(self, name: str) -> bool:
        """Whether a picture has coverage; raises as `spec`."""
        if name not in self._alphas:
            self._alphas[name] = measure(sibling(self._files, name))["has_alpha"]
        return self._alphas[name]

    def is_grey(self, name: str) -> bool:
        """Whether a picture is nearly grey nearly everywhere; raises as `spec`."""
        if name not in self._greys:
            self._greys[name] = _is_grey(sibling(self._files, name))
        return self._greys[name]


def measure(content: bytes) -> image_io.ImageFacts:
    """Decode a picture and say what it is.

    Raises:
        UnusableAssetError: It is no picture, damaged or too large.
    """
    with _stored(content) as path:
        return image_io.measure(path)


def _is_grey(content: bytes) -> bool:
    with _stored(content) as path:
        pixels = image_io.read(path, "linear", "data").pixels
    if pixels.shape[2] < 3:
        return True
    spread = pixels[..., :3].max(axis=2) - pixels[..., :3].min(axis=2)
    return bool((spread < _GREY_SPREAD).mean() > _GREY_SHARE)


def _holds_floats(content: bytes) -> bool:
    """Whether a picture holds floats; only where the kind does not tell is it decoded."""
    kind = next((kind.format for kind in FILE_KINDS if content.startswith(kind.magics)), None)
    known = {"png": False, "jpeg": False, "hdr": True, "openexr": True}
    return known[kind] if kind in known else measure(content)["float"]


@contextmanager
def _stored(content: bytes) -> Iterator[Path]:
    with tempfile.NamedTemporaryFile() as file:
        file.write(content)
        file.flush()
        yield Path(file.name)
