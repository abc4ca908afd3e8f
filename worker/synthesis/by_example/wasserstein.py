"""How far the patches of two pictures are from each other as a whole (Rabin et al., 2012).

The work it takes to move the ones to the others along a line, the mean over some lines. It sees
whether all kinds of patches are there as often; it does not see whether they fit to each other, and
prefers what the eye does not: it is told, and nothing is judged by it.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view
from scipy.special import ndtri

from worker.synthesis._counter_hash import uniforms
from worker.synthesis.by_example.windows import whole_windows

if TYPE_CHECKING:
    from worker.synthesis.by_example.arrays import Bytes, Mask, Numbers


_LINES = 32
_SAMPLES = 1024


def sliced_wasserstein(
    ours: Bytes, known: Mask, theirs: Bytes, usable: Mask, side: int
) -> float | None:
    """Return the distance, 0 for equal pictures and about 1 from black to white, or None.

    Args:
        ours: Features, (height, width, channels).
        known: Which of them count.
        theirs: Features of the other picture, with as many channels.
        usable: Which of them count.
        side: Of a patch, in pixels; None where no patch fits one of the pictures.
    """
    first, second = _sampled(ours, known, side), _sampled(theirs, usable, side)
    if first is None or second is None:
        return None
    length = first.shape[1]
    chances = np.maximum(uniforms(0, 0, length * _LINES), 2.0**-53)
    lines = ndtri(chances).reshape(length, _LINES)
    return round(moved(first, second, lines / np.linalg.norm(lines, axis=0)) / 255, 5)


def moved(first: Numbers, second: Numbers, lines: Numbers) -> float:
    """Return the mean way, over lines (numbers, lines), from points to as many others.

    Points are (points, numbers).
    """
    ours, theirs = np.sort(first @ lines, axis=0), np.sort(second @ lines, axis=0)
    return float(np.abs(ours - theirs).mean())


def _sampled(features: Bytes, known: Mask, side: int) -> Numbers | None:
    """Return patches as lines of numbers, evenly taken from all: always as many."""
    corners = np.flatnonzero(whole_windows(known, (side, side)))
    if not corners.size:
        return None
    chosen = corners[np.linspace(0, corners.size - 1, _SAMPLES).astype(np.int64)]
    windows = sliding_window_view(features, (side, side), (0, 1))
    rows, columns = np.divmod(chosen, windows.shape[1])
    return windows[rows, columns].reshape(_SAMPLES, -1).astype(np.float64)
