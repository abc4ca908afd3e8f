"""How large a model may be; told before anything of that size is allocated."""

from typing import Final

from worker.errors import UnusableAssetError

TRIANGLES_MAX: Final = 2**22
"""Four times what a large model has; as flat triangles 0.6 GB of vertices."""
VERTICES_MAX: Final = 2**23
"""Vertices, and also points and pieces of lines."""


def check_size(count: int, most: int, what: str) -> None:
    """Refuse a model that has, or claims to have, more of something than is taken.

    Raises:
        UnusableAssetError: `asset_too_large`.
    """
    if count > most:
        raise UnusableAssetError(
            f"the model has {count:g} {what}; the most is {most}", code="asset_too_large"
        )
