"""The files beside a model, which it speaks of by name: looked up in a set, never on a disk."""

import re
from collections.abc import Mapping

from worker.errors import AssetMissingError, UnusableAssetError

NAME_LENGTH_MAX = 256
_SHOWN_MAX = 64
_SCHEME = re.compile(r"[A-Za-z][A-Za-z0-9+.-]+:")  # two letters or more: C: is a drive
_DRIVE = re.compile(r"[A-Za-z]:")


def sibling_name(written: str) -> str:
    r"""Give the name by which a file is looked up.

    Folders are parted by /, also where \ was written, and a leading ./ is dropped. A path that
    leaves the model's folder (by .., from the root, from a drive) counts by its last part.

    Raises:
        UnusableAssetError: `asset_unsupported` for a URL, `asset_unusable` for no name at all.
    """
    if _SCHEME.match(written):
        raise UnusableAssetError(
            "a file beside the model is named by a URL; nothing is fetched",
            code="asset_unsupported",
        )
    steps = written.replace("\\", "/").split("/")
    inner = [step for step in steps if step not in ("", ".")]
    leaves = steps[0] == "" or ".." in inner or _DRIVE.match(written) is not None
    name = (inner[-1] if leaves else "/".join(inner)) if inner else ""
    if name in ("", "..") or len(name) > NAME_LENGTH_MAX:
        raise UnusableAssetError(
            f"a file beside the model has no name of 1 to {NAME_LENGTH_MAX} characters"
        )
    return name


def sibling(files: Mapping[str, bytes], written: str) -> bytes:
    """Take a file from a model's set, by its name as written or as `sibling_name` gives it.

    Raises:
        AssetMissingError: `asset_file_missing`.
        UnusableAssetError: As `sibling_name`.
    """
    content = files.get(written)
    if content is None:
        content = files.get(sibling_name(written))
    if content is None:
        raise AssetMissingError(
            f"the model needs a file {shown(sibling_name(written))}, which is not in its set",
            code="asset_file_missing",
        )
    return content


def shown(name: str) -> str:
    """Make a name fit for a message: printable, and not longer than 64 characters."""
    safe = "".join(c if c.isprintable() and c not in "<>&\"'`" else "?" for c in name)
    return safe if len(safe) <= _SHOWN_MAX else safe[: _SHOWN_MAX - 3] + "..."


def decoded(name: bytes) -> str:
    """Read a name from a text file: UTF-8, or Latin-1 where it is none."""
    try:
        return name.decode().strip()
    except UnicodeDecodeError:
        return name.decode("latin-1").strip()
