"""How large a model may be; told before anything of that size is allocated."""

from typing import Final

import numpy as np
from numpy.typing import NDArray

from worker.errors import UnusableAssetError

TRIANGLES_MAX: Final = 2**22
"""Four times what a large model has; as flat triangles 0.6 GB of vertices."""
VERTICES_MAX: Final = 2**23
"""Vertices, and also points and pieces of lines."""
WARNINGS_MAX: Final = 64
"""Told of one model; who has read so many has understood."""
FARTHEST: Final = 1e9
"""Largest coordinate: float32 squares of it are still numbers."""


def check_positions(positions: NDArray[np.float64]) -> None:
    """Refuse vertices that are no points in space.

    Raises:
        UnusableAssetError: `asset_unusable`.
    """
    if not (np.abs(positions) <= FARTHEST).all():
        raise UnusableAssetError(f"a vertex is not three numbers within +-{FARTHEST:g}")


def check_uv(uv: NDArray[np.float64]) -> None:
    """Refuse texture coordinates that float32 cannot hold with a part of a tile to spare.

    Raises:
        UnusableAssetError: `asset_unusable`.
    """
    if not (np.abs(uv) <= FARTHEST).all():
        raise UnusableAssetError(f"a texture coordinate is not two numbers within +-{FARTHEST:g}")


def check_size(count: int, most: int, what: str) -> None:
    """Refuse a model that has, or claims to have, more of something than is taken.

    Raises:
        UnusableAssetError: `asset_too_large`.
    """
    if count > most:
        raise UnusableAssetError(
            f"the model has {count} {what}; the most is {most}", code="asset_too_large"
        )
