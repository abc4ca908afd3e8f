"""The pictures in a model's set: what has to be known of them before they are drawn."""

import hashlib
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from api_schemas.families import Meaning
from api_schemas.textures.image import ImageSpec
from worker.images import image_io
from worker.images.file_kinds import FILE_KINDS

_GREY_SPREAD = 0.1  # more than the noise of a JPEG, less than the colours of a normal map
_GREY_SHARE = 0.99


def picture_of(content: bytes, meaning: Meaning) -> ImageSpec:
    """Name a picture by its hash, and say how its numbers are read.

    Pictures of 8 and 16 bits are sRGB in the place of a colour, as uploads are; their alpha has no
    meaning there.

    Raises:
        UnusableAssetError: It is no picture, or damaged.
    """
    is_srgb = meaning == "colour" and not _holds_floats(content)
    return ImageSpec(
        technique="image",
        asset=hashlib.sha256(content).hexdigest(),
        encoding="srgb" if is_srgb else "linear",
        alpha="ignore" if meaning == "colour" else "use",
    )


def measure(content: bytes) -> image_io.ImageFacts:
    """Decode a picture and say what it is.

    Raises:
        UnusableAssetError: It is no picture, damaged or too large.
    """
    with _stored(content) as path:
        return image_io.measure(path)


def has_alpha(content: bytes) -> bool:
    """Whether a picture has coverage."""
    return measure(content)["has_alpha"]


def is_grey(content: bytes) -> bool:
    """Whether red, green and blue are nearly equal nearly everywhere, or there is one of them."""
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
