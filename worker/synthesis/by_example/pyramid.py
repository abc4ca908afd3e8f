"""Pictures at half, a quarter, an eighth of their size, for searching from coarse to fine."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Bytes = NDArray[np.uint8]
    Mask = NDArray[np.bool_]

_TAPS = np.array([1, 3, 3, 1], np.float32) / 8


def halved(features: Bytes, known: Mask, *, wraps: bool = False) -> tuple[Bytes, Mask]:
    """Return features (height, width, channels) at half the size, and what is known of them.

    New pixel i lies over the old ones 2 i and 2 i + 1; a weight of 1 3 3 1 goes to these and their
    neighbours. Only known pixels count, and the new one is known where most of its four are.
    """
    weights = known[..., np.newaxis].astype(np.float32)
    total = _shrink(features * weights, wraps)
    weight = _shrink(weights, wraps)
    mean = np.divide(total, weight, out=np.zeros_like(total), where=weight > 0)
    return np.rint(mean).astype(np.uint8), weight[..., 0] >= 0.5


def doubled(
    values: NDArray[np.int32], rows: NDArray[np.int64], columns: NDArray[np.int64], stride: int = 1
) -> NDArray[np.int32]:
    """Return coordinates within a picture twice as large, of its pixels at some rows and columns.

    Pixel 2 i + k gets twice the coordinate of the smaller one's pixel i, plus k: axis 0 of `values`
    holds rows and columns. Where it knows only every `stride`th pixel, they go on from there.
    """
    step = 2 * stride
    old_rows = np.minimum(rows // step, values.shape[1] - 1)
    old_columns = np.minimum(columns // step, values.shape[2] - 1)
    old = values[:, old_rows[:, np.newaxis], old_columns] * 2
    old[0] += (rows - step * old_rows)[:, np.newaxis].astype(np.int32)
    old[1] += (columns - step * old_columns).astype(np.int32)
    return old


def _shrink(values: NDArray[np.float32], wraps: bool) -> NDArray[np.float32]:
    for axis in (0, 1):
        count = values.shape[axis] // 2
        if count == 0:
            continue
        margins = [(0, 0)] * 3
        margins[axis] = (1, 2)
        padded = np.pad(values, margins, mode="wrap" if wraps else "edge")
        lines = np.moveaxis(padded, axis, 0)
        parts = [weight * lines[k : k + 2 * count : 2] for k, weight in enumerate(_TAPS)]
        values = np.moveaxis(parts[0] + parts[1] + parts[2] + parts[3], 0, axis)
    return values
