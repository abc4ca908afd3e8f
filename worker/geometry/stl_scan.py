"""Kernels that find the vertices in an STL text."""

from __future__ import annotations

from typing import TYPE_CHECKING

from worker.geometry.text import number, word_end, word_start
from worker.numba_kernel import kernel

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

_LETTERS = b"vertex"
_END_OF_LOOP = b"endloop"


@kernel
def count_vertices(text: NDArray[np.uint8]) -> int:
    """Count the words "vertex"; -1 if a loop has not three of them, or never ends."""
    count, in_loop = 0, 0
    at = word_start(text, 0, len(text))
    while at < len(text):
        end = word_end(text, at, len(text))
        if _is(text, at, end, _LETTERS):
            count += 1
            in_loop += 1
        elif _is(text, at, end, _END_OF_LOOP):
            if in_loop != 3:
                return -1
            in_loop = 0
        at = word_start(text, end, len(text))
    return count if in_loop == 0 else -1


@kernel
def read_vertices(text: NDArray[np.uint8], corners: NDArray[np.float64]) -> None:
    """Fill (n, 3) with the three words after each "vertex", NaN where one is no number."""
    row = 0
    at = word_start(text, 0, len(text))
    while row < len(corners):
        end = word_end(text, at, len(text))
        if _is(text, at, end, _LETTERS):
            for axis in range(3):
                at = word_start(text, end, len(text))
                end = word_end(text, at, len(text))
                corners[row, axis] = number(text, at, end)
            row += 1
        at = word_start(text, end, len(text))


@kernel
def _is(text: NDArray[np.uint8], start: int, end: int, word: bytes) -> bool:
    """Whether a word is another one, in small letters or in capitals."""
    index = 0
    while index < min(end - start, len(word)) and text[start + index] | 32 == word[index]:
        index += 1
    return index == end - start == len(word)
