"""Two colours blended by a product of one function of the column and one of the row."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

_BAND_ROWS = 64


def blended(
    colors: Sequence[Sequence[float]], across: NDArray[np.float64], down: NDArray[np.float64]
) -> NDArray[np.float32]:
    """Return (rows, columns, 3) with the share (1 + down across) / 2 of the first colour."""
    first, second = np.array(colors, np.float32).astype(np.float64)
    signs, row_kinds = np.unique(down, return_inverse=True)
    rows = np.empty((len(signs), len(across), len(first)), np.float32)
    # In float64, so that pure colours and equal colours come out exactly; banded to stay small
    for start in range(0, len(signs), _BAND_ROWS):
        products = np.multiply.outer(signs[start : start + _BAND_ROWS], across)
        share = (0.5 + 0.5 * products)[..., np.newaxis]
        rows[start : start + _BAND_ROWS] = share * first + (1 - share) * second
    return rows[row_kinds]
