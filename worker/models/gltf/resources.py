"""The bytes a document speaks of: buffers and pictures, each found once and checked."""

import hashlib
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Final

from worker.models.gltf.document.pictures import Image
from worker.models.gltf.document.root import Document
from worker.models.gltf.faults import too_large, unusable
from worker.models.gltf.limits import DATA_URI_BYTES_MAX, PICTURE_BYTES_MAX
from worker.models.gltf.picture_files import (
    BrokenPictureError,
    PictureFile,
    kind_of,
    look_at,
)
from worker.models.gltf.uris import Resource, fetch, is_data
from worker.models.gltf.uris import file_name as name_in

PICTURE_TYPES: Final = ("image/png", "image/jpeg")


@dataclass(frozen=True, slots=True)
class Picture:
    """A picture that can be drawn: its bytes, their SHA-256, and what their header says."""

    content: bytes
    sha256: str
    header: PictureFile


@dataclass(frozen=True, slots=True)
class Resources:
    """Everything outside the JSON.

    Attributes:
        buffers: By index; None where nobody says what is in it.
        pictures: By index; None where it is a kind that is not drawn.
        warnings: Which pictures are not drawn.
    """

    buffers: tuple[memoryview | None, ...]
    pictures: tuple[Picture | None, ...]
    warnings: tuple[str, ...]

    @classmethod
    def find(
        cls, document: Document, binary: memoryview | None, files: Mapping[str, bytes] | None
    ) -> "Resources":
        """Find buffers and pictures.

        Args:
            document: With references that exist.
            binary: The binary chunk, which is the first buffer if that has no URI.
            files: What lies beside the asset; None leaves out what should lie there.

        Raises:
            AssetMissingError: `asset_file_missing`.
            UnusableAssetError: Something is shorter than it should be, or no valid picture; data
                URIs together are too long (`asset_too_large`).
        """
        _check_data_uris(document)
        buffers = tuple(
            _buffer(document, index, binary, files) for index in range(len(document.buffers))
        )
        shelf = _Shelf()
        pictures: list[Picture | None] = []
        warnings = []
        for index, image in enumerate(document.images):
            place = f"/images/{index}"
            if files is None and _lies_beside(document, image):
                pictures.append(None)
                continue
            if _source(image) not in shelf.by_source:
                shelf.put(image, _image(document, buffers, image, files or {}, place), place)
            kind, picture = shelf.by_source[_source(image)]
            if picture is None:
                warnings.append(f"{place}: a picture of kind {kind} is not drawn")
            elif image.mime_type in PICTURE_TYPES and image.mime_type != kind:
                raise unusable(place, f"the picture is {kind} and is called {image.mime_type}")
            pictures.append(picture)
        return cls(buffers, tuple(pictures), tuple(warnings))


class _Shelf:
    """Pictures by where they come from, so that none is hashed twice."""

    def __init__(self) -> None:
        self.by_source: dict[str | int, tuple[str, Picture | None]] = {}
        self._bytes = 0

    def put(self, image: Image, found: Resource, place: str) -> None:
        """Take a picture in, or that it is of a kind that is not drawn."""
        self._bytes += len(found.content)
        if self._bytes > PICTURE_BYTES_MAX:
            raise too_large(place, f"its pictures have more than {PICTURE_BYTES_MAX} bytes")
        kind = kind_of(found.content)
        picture = None
        if kind in PICTURE_TYPES:
            if found.media_type not in (None, kind):
                raise unusable(place, f"the picture is {kind} and its data URI says otherwise")
            try:
                header = look_at(found.content)
            except BrokenPictureError as error:
                raise unusable(place, str(error)) from None
            digest = hashlib.sha256(found.content).hexdigest()
            picture = Picture(bytes(found.content), digest, header)
        self.by_source[_source(image)] = (kind, picture)


def _source(image: Image) -> str | int:
    return image.uri if image.uri is not None else image.buffer_view or 0


def needed_files(document: Document) -> tuple[str, ...]:
    """Return the names of the files that must lie beside the asset, each once.

    Raises:
        UnusableAssetError: A URI is none of a file beside the asset.
    """
    uris = [(f"/buffers/{i}/uri", buffer.uri) for i, buffer in enumerate(document.buffers)]
    uris += [(f"/images/{i}/uri", image.uri) for i, image in enumerate(document.images)]
    names = [name_in(uri, place) for place, uri in uris if uri is not None and not is_data(uri)]
    return tuple(dict.fromkeys(names))


def _is_name(uri: str | None) -> bool:
    return uri is not None and not is_data(uri)


def _lies_beside(document: Document, image: Image) -> bool:
    if image.buffer_view is None:
        return _is_name(image.uri)
    return _is_name(document.buffers[document.buffer_views[image.buffer_view].buffer].uri)


def _check_data_uris(document: Document) -> None:
    uris = [item.uri for item in document.buffers] + [item.uri for item in document.images]
    total = sum(len(uri) for uri in uris if uri is not None and is_data(uri))
    if total > DATA_URI_BYTES_MAX:
        raise too_large(
            "/buffers",
            f"{total} bytes in data URIs; at most {DATA_URI_BYTES_MAX} are taken, a GLB holds more",
        )


def _buffer(
    document: Document, index: int, binary: memoryview | None, files: Mapping[str, bytes] | None
) -> memoryview | None:
    buffer, place = document.buffers[index], f"/buffers/{index}"
    if files is None and _is_name(buffer.uri):
        return None
    if buffer.uri is not None:
        content = memoryview(fetch(buffer.uri, files or {}, f"{place}/uri").content)
    elif index == 0 and binary is not None:
        content = binary
    else:
        return None
    if len(content) < buffer.byte_length:
        raise unusable(
            place, f"{buffer.byte_length} bytes are claimed where there are {len(content)}"
        )
    return content


def _image(
    document: Document,
    buffers: tuple[memoryview | None, ...],
    image: Image,
    files: Mapping[str, bytes],
    place: str,
) -> Resource:
    if image.uri is not None:
        found = fetch(image.uri, files, f"{place}/uri")
        if found.media_type is not None and found.media_type not in PICTURE_TYPES:
            raise unusable(place, "the data URI is not called image/png or image/jpeg")
        return found
    view = document.buffer_views[image.buffer_view or 0]
    content = buffers[view.buffer]
    if content is None:
        raise unusable(place, "the buffer has no data")
    return Resource(content[view.byte_offset : view.byte_offset + view.byte_length])
