"""URIs of buffers and pictures: data inside the document, or names in a set; never a place.

What a name stands for is looked up in the mapping that came with the asset, so no file and no
network can be reached; names that look like an attempt are refused all the same, and say so.
"""

import binascii
import re
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Final
from urllib.parse import unquote_to_bytes

from worker.errors import AssetMissingError
from worker.models.gltf.faults import unsupported, unusable
from worker.models.siblings import NAME_LENGTH_MAX, shown

_DATA: Final = "data:"
_MEDIA_TYPE: Final = re.compile(r"[a-z0-9.+-]{1,64}/[a-z0-9.+-]{1,64}")
_SCHEME: Final = re.compile(r"[A-Za-z][A-Za-z0-9+.-]*:")
_PERCENT: Final = re.compile(r"%(?![0-9A-Fa-f]{2})")


@dataclass(frozen=True, slots=True)
class Resource:
    """Bytes that a URI stands for, and what it calls them."""

    content: bytes | memoryview
    media_type: str | None = None


def is_data(uri: str) -> bool:
    """Whether the URI holds its bytes itself."""
    return uri[: len(_DATA)].lower() == _DATA


def fetch(uri: str, files: Mapping[str, bytes], place: str) -> Resource:
    """Decode a data URI, or look a relative one up in the set of files.

    Raises:
        AssetMissingError: The set has no file of this name (`asset_file_missing`).
        UnusableAssetError: `asset_unusable` for no valid URI, or one that leaves the asset's
            folder; `asset_unsupported` for one with a scheme, which would have to be fetched.
    """
    if is_data(uri):
        return _decoded(uri, place)
    name = file_name(uri, place)
    if name not in files:
        raise AssetMissingError(
            f"{place}: the file {shown(name)} is not in the set", code="asset_file_missing"
        )
    return Resource(files[name])


def file_name(uri: str, place: str) -> str:
    """Return the name that a relative URI gives a file, percent-decoded once.

    Raises:
        UnusableAssetError: It is no plain relative path; see `fetch`.
    """
    if _SCHEME.match(uri):
        raise unsupported(place, "the URI has a scheme; nothing is fetched from anywhere")
    if _PERCENT.search(uri) or any(character in uri for character in "?#"):
        raise unusable(place, "the URI is not a plain relative path")
    try:
        name = unquote_to_bytes(uri).decode()
    except UnicodeError:
        raise unusable(place, "the URI is not UTF-8") from None
    steps = name.split("/")
    if (
        not name
        or len(name) > NAME_LENGTH_MAX
        or "\\" in name
        or ":" in name
        or "%" in name
        or not name.isprintable()
        or any(step in ("", ".", "..") for step in steps)
    ):
        raise unusable(
            place, f"the URI is not a plain relative path of 1 to {NAME_LENGTH_MAX} characters"
        )
    return name


def _decoded(uri: str, place: str) -> Resource:
    head, comma, text = uri[len(_DATA) :].partition(",")
    media_type, *parameters = head.lower().split(";")
    if not comma or parameters[-1:] != ["base64"]:
        raise unusable(place, "the data URI is not base64")
    if media_type and not _MEDIA_TYPE.fullmatch(media_type):
        raise unusable(place, "the data URI has no valid media type")
    try:
        # Some writers percent-encode + and / and =.
        bare = unquote_to_bytes(text) if "%" in text else text.encode("ascii")
        content = binascii.a2b_base64(bare, strict_mode=True)
    except (ValueError, UnicodeError):
        raise unusable(place, "the data URI is not valid base64") from None
    return Resource(content, media_type or None)
