"""Smaller levels by a Kaiser-windowed sinc: sharper in the distance than box means."""

import numpy as np
from numpy.typing import NDArray

from api_schemas.families import Wrap

_REACH = 3.0
"""Texels of the smaller level to each side that a texel is made from."""
_ALPHA = 4.0
"""Shape of the window: larger blurs more and rings less. Both as in NVIDIA's texture tools."""


def kaiser_chain(pixels: NDArray[np.float32], wrap: tuple[Wrap, Wrap]) -> list[NDArray[np.float32]]:
    """Give the picture and its smaller levels, each half the one before, rounded down.

    Each level is the one before through sinc(x) I0(a sqrt(1 - (x/3)^2)) / I0(a), x in texels of
    the smaller one (Kaiser, 1966), along u and then v. The weights of a texel add up to 1, and of
    even sides that repeat each old texel counts alike, so their means are kept. The window's
    negative lobes overshoot at edges.

    Args:
        pixels: float32 (H, W, C), linear light, alpha premultiplied. Level 0 is this array.
        wrap: What lies beyond the edges along u and v; beyond a border's is the edge itself.
    """
    levels = [pixels]
    while max(levels[-1].shape[:2]) > 1:
        across = _halve(levels[-1].swapaxes(0, 1), wrap[0]).swapaxes(0, 1)
        levels.append(np.ascontiguousarray(_halve(across, wrap[1]), dtype=np.float32))
    return levels


def _halve(lines: NDArray[np.float32], wrap: Wrap) -> NDArray[np.float32]:
    """Make half as many lines, (n, ...), of float64 sums."""
    count = len(lines)
    if count == 1:
        return lines
    texels, weights = _taps(count, wrap)
    halved = np.zeros((len(texels), *lines.shape[1:]))
    for tap in range(texels.shape[1]):
        halved += weights[:, tap].reshape(-1, *[1] * (lines.ndim - 1)) * lines[texels[:, tap]]
    return halved.astype(np.float32)


def _taps(count: int, wrap: Wrap) -> tuple[NDArray[np.int64], NDArray[np.float64]]:
    """Return which of `count` texels make each one of half as many, and by which weights."""
    smaller = count // 2
    stretch = count / smaller
    middles = (np.arange(smaller) + 0.5) * stretch - 0.5
    first = np.ceil(middles - _REACH * stretch).astype(np.int64)
    texels = first[:, None] + np.arange(int(np.ceil(2 * _REACH * stretch)) + 1)
    x = (texels - middles[:, None]) / stretch
    inside = np.clip(1 - (x / _REACH) ** 2, 0, None)
    weights = np.where(abs(x) < _REACH, np.sinc(x) * np.i0(_ALPHA * np.sqrt(inside)), 0.0)
    weights /= weights.sum(axis=1, keepdims=True)
    if wrap == "repeat":
        return texels % count, weights
    if wrap == "mirror":
        folded = texels % (2 * count)
        return np.minimum(folded, 2 * count - 1 - folded), weights
    return np.clip(texels, 0, count - 1), weights
