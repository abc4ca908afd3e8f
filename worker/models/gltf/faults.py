"""Refusals that say where: a JSON pointer into the glTF document, then what is wrong there.

Nothing of the file is repeated but words that have passed `spoken`.
"""

import re
from typing import Final

from worker.errors import UnusableAssetError

_WORD: Final = re.compile(r"[A-Za-z0-9_]{1,64}")


def unusable(place: str, what: str) -> UnusableAssetError:
    """Say that the file contradicts itself or glTF."""
    return UnusableAssetError(f"{place or '/'}: {what}")


def unsupported(place: str, what: str) -> UnusableAssetError:
    """Say that the file asks for something that is glTF but not done here."""
    return UnusableAssetError(f"{place or '/'}: {what}", code="asset_unsupported")


def too_large(place: str, what: str) -> UnusableAssetError:
    """Say that the file asks for more than a budget."""
    return UnusableAssetError(f"{place or '/'}: {what}", code="asset_too_large")


def spoken(word: object) -> str:
    """Return a word of the file if it is harmless in a message, else a stand-in."""
    return word if isinstance(word, str) and _WORD.fullmatch(word) else "?"
