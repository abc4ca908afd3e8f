"""Which row filter makes a PNG small and quick: measured on a sample, not tried on every row."""

from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

PngFilter = Literal["none", "sub", "up"]

_SAMPLED_ROWS = 16


def choose_png_filter(codes: NDArray[Any]) -> PngFilter:
    """Choose the filter (PNG, third edition, 9.2) whose bytes have the least entropy.

    Flat pictures stay as they are, noisy and smooth ones become differences to the left or to the
    row above. Ties go to the earlier of none, sub, up.

    Args:
        codes: uint8 or uint16, shape (height, width, channels).
    """
    height = codes.shape[0]
    count = min(_SAMPLED_ROWS, height)
    rows = np.linspace(0, height - 1, count).astype(np.intp)
    sample = _bytes_of_rows(codes[rows])
    above = _bytes_of_rows(codes[np.maximum(rows - 1, 0)])
    texel_bytes = codes.shape[2] * codes.dtype.itemsize
    filtered: dict[PngFilter, NDArray[np.uint8]] = {
        "none": sample,
        "sub": sample[:, texel_bytes:] - sample[:, :-texel_bytes],
        "up": (sample - above)[rows > 0],
    }
    entropies = {name: _entropy(data) for name, data in filtered.items() if data.size}
    return min(entropies, key=entropies.__getitem__)


def _bytes_of_rows(codes: NDArray[Any]) -> NDArray[np.uint8]:
    return codes.reshape(codes.shape[0], -1).view(np.uint8)


def _entropy(data: NDArray[np.uint8]) -> float:
    """Give the bits per byte of a memoryless source (Shannon 1948)."""
    shares = np.bincount(data.reshape(-1), minlength=256) / data.size
    return float(-(shares * np.log2(shares, where=shares > 0, out=np.zeros(256))).sum())
