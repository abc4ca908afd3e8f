"""Mip chains: a picture at half, a quarter, an eighth ... of its size, the mean kept on each."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray


@dataclass(frozen=True, slots=True)
class Cut:
    """Where holes are: what is below `cutoff` of scale * texel + bias, in one of the channels."""

    channel: int
    scale: float
    bias: float
    cutoff: float


def keep_coverage(levels: list[NDArray[np.float32]], cut: Cut) -> None:
    """Let each smaller level have as large a share of holes as the first, as nearly as it can.

    Means of thin leaves fall below the cutoff everywhere, and of thin gaps nowhere. So the opacity
    of each level is multiplied by one number, by which the right count of texels reaches it
    (Castano, 2010).

    Args:
        levels: From `mip_chain`; all but the first are changed.
        cut: Which numbers are opacity.
    """
    channels = levels[0].shape[2]
    channel = 0 if channels == 1 and cut.channel < 3 else cut.channel  # a grey is red, green, blue
    if channel >= channels or not cut.scale or not cut.cutoff:
        return
    first = _opacity(levels[0], channel, cut)
    share = np.count_nonzero(first >= cut.cutoff) / first.size
    for level in levels[1:]:
        opacity = np.sort(_opacity(level, channel, cut), axis=None)
        holes = _possible(opacity, opacity.size - round(share * opacity.size))
        # Factors between these make so many holes; the one nearest to 1 changes least.
        most = cut.cutoff / opacity[holes - 1] if holes and opacity[holes - 1] > 0 else np.inf
        least = cut.cutoff / opacity[holes] if holes < opacity.size and opacity[holes] > 0 else 0.0
        factor = max(min(1.0, most * (1 - 1e-6)), least * (1 + 1e-6))
        level[..., channel] = factor * level[..., channel] + (factor - 1) * cut.bias / cut.scale


def _possible(ordered: NDArray[np.float64], holes: int) -> int:
    """Return the nearest number of holes that leaves equal texels together."""
    if holes == ordered.size:
        return holes
    fewer = np.searchsorted(ordered, ordered[holes], "left")
    more = np.searchsorted(ordered, ordered[holes], "right")
    return int(fewer if holes - fewer <= more - holes else more)


def _opacity(level: NDArray[np.float32], channel: int, cut: Cut) -> NDArray[np.float64]:
    with np.errstate(over="ignore", invalid="ignore"):
        opacity = cut.scale * level[..., channel].astype(np.float64) + cut.bias
    return np.clip(np.nan_to_num(opacity, nan=0.0), 0.0, 1.0)


def mip_chain(pixels: NDArray[np.float32]) -> list[NDArray[np.float32]]:
    """Give the picture and its box means down to one texel (Williams 1983).

    There are floor(log2 max(W, H)) + 1 levels; a side of n texels becomes max(1, floor(n / 2)), as
    GL wants. Each texel is the mean of the area it covers, so that every level has the mean
    of the first up to float32 rounding, odd sides included (Guthe and Heckbert 2005).

    Args:
        pixels: float32, shape (H, W, C), linear light, alpha premultiplied. Level 0 is this array.
    """
    levels = [pixels]
    while max(levels[-1].shape[:2]) > 1:
        levels.append(halve_width(halve_height(levels[-1])))
    return levels


def halve_height(pixels: NDArray[np.float32]) -> NDArray[np.float32]:
    """Give half as many rows, rounded down; one stays one."""
    height = pixels.shape[0]
    if height == 1:
        return pixels
    if height % 2 == 0:
        return (pixels[0::2] + pixels[1::2]) * np.float32(0.5)
    first, middle, last = (weights[:, None, None] for weights in _odd_weights(height))
    halved: NDArray[np.float32] = first * pixels[0:-2:2]
    halved += middle * pixels[1:-1:2]
    halved += last * pixels[2::2]
    return halved


def halve_width(pixels: NDArray[np.float32]) -> NDArray[np.float32]:
    """Give half as many columns, rounded down; one stays one."""
    width = pixels.shape[1]
    if width == 1:
        return pixels
    halved = np.empty((pixels.shape[0], width // 2, pixels.shape[2]), np.float32)
    # Channel by channel: numpy's inner loop then runs along a row, not over four numbers.
    for channel in range(pixels.shape[2]):
        row, out = pixels[:, :, channel], halved[:, :, channel]
        if width % 2 == 0:
            np.add(row[:, 0::2], row[:, 1::2], out=out)
            out *= np.float32(0.5)
        else:
            first, middle, last = _odd_weights(width)
            np.multiply(middle, row[:, 1:-1:2], out=out)
            out += first * row[:, 0:-2:2]
            out += last * row[:, 2::2]
    return halved


def _odd_weights(
    side: int,
) -> tuple[NDArray[np.float32], NDArray[np.float32], NDArray[np.float32]]:
    """Weigh the three texels under each texel of the next level, for a side of 2m + 1 texels.

    Texel j covers (2m + 1)/m texels from j (2m + 1)/m on: the parts are (m - j), m and (j + 1)
    of 2m + 1.
    """
    half = side // 2
    texel = np.arange(half, dtype=np.float64)
    parts = (half - texel, np.full(half, float(half)), texel + 1)
    first, middle, last = ((part / side).astype(np.float32) for part in parts)
    return first, middle, last
