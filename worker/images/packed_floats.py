"""Numbers of 32 bits as the four bytes of a pixel, the most significant one in red."""

import numpy as np
from numpy.typing import NDArray

from api_schemas.base import FLOAT32_MAX

_BYTE_MAX = 255
_BIG_ENDIAN = np.dtype(">u4")


def packed(numbers: NDArray[np.float32]) -> NDArray[np.float32]:
    """Return (height, width, 4) bytes, each B as B / 255, of numbers (height, width)."""
    bits = np.ascontiguousarray(numbers, dtype=np.float32).view(np.uint32).astype(_BIG_ENDIAN)
    held = bits.view(np.uint8).reshape(*numbers.shape, 4).astype(np.float32)
    return held / np.float32(_BYTE_MAX)


def unpacked(texels: NDArray[np.float32]) -> NDArray[np.float32]:
    """Return the numbers (height, width) of bytes (height, width, 1..4).

    A channel that is missing counts as 0, alpha as 255. What lies between two bytes is the nearer
    one. What is not finite becomes 0 or the largest number.
    """
    height, width, channels = texels.shape
    held = np.zeros((height, width, 4), np.uint8)
    held[..., 3] = _BYTE_MAX
    values = np.clip(np.nan_to_num(texels), 0, 1).astype(np.float64)
    held[..., :channels] = np.rint(values * _BYTE_MAX)
    bits = held.view(_BIG_ENDIAN)[..., 0].astype(np.uint32)
    return np.nan_to_num(bits.view(np.float32), posinf=FLOAT32_MAX, neginf=-FLOAT32_MAX)
