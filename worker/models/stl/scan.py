"""Kernels that find the vertices in an STL text."""

from __future__ import annotations

from typing import TYPE_CHECKING

from worker.models.text import number, word_end, word_start
from worker.numba_kernel import kernel

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

_FACET = b"facet"
_VERTEX = b"vertex"
_END_OF_LOOP = b"endloop"


@kernel
def read_vertices(text: NDArray[np.uint8], corners: NDArray[np.float64]) -> int:
    """Read the three words after each "vertex".

    Args:
        text: The file.
        corners: (n, 3): filled as far as it reaches, NaN where a word is no number.

    Returns:
        How many vertices there are; -1 if a facet has not one loop of three, or never ends.
    """
    count, in_loop, facets = 0, 0, 0
    at = word_start(text, 0, len(text))
    while at < len(text):
        end = word_end(text, at, len(text))
        if _is(text, at, end, _VERTEX):
            for axis in range(3):
                at = word_start(text, end, len(text))
                end = word_end(text, at, len(text))
                if count < len(corners):
                    corners[count, axis] = number(text, at, end)
            count += 1
            in_loop += 1
        elif _is(text, at, end, _END_OF_LOOP):
            if in_loop != 3:
                return -1
            in_loop = 0
        elif _is(text, at, end, _FACET):
            facets += 1
        at = word_start(text, end, len(text))
    return count if in_loop == 0 and count == 3 * facets else -1


@kernel
def _is(text: NDArray[np.uint8], start: int, end: int, word: bytes) -> bool:
    """Whether a word is another one, in small letters or in capitals."""
    index = 0
    while index < min(end - start, len(word)) and text[start + index] | 32 == word[index]:
        index += 1
    return index == end - start == len(word)
