"""Kernels that read words and numbers from the bytes of a text file.

Whatever is not printable parts words; a line ends at every line feed and carriage return.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from worker.numba_kernel import kernel

if TYPE_CHECKING:
    from numpy.typing import NDArray

_POWERS_OF_TEN = np.array([float(f"1e{exponent}") for exponent in range(309)])
_DIGITS_KEPT = 18  # the most that an int64 always holds
_WHOLE_MAX = 2**53

NEWLINE, RETURN, SPACE, HASH, PLUS, MINUS, DOT, SLASH, ZERO, NINE = b"\n\r #+-./09"
_LOWER_E, _UPPER_E = b"eE"


@kernel
def line_end(text: NDArray[np.uint8], at: int) -> int:
    """Where the line ends that goes on at `at`: at its line feed, or at the end of the text."""
    while at < len(text) and text[at] != NEWLINE and text[at] != RETURN:
        at += 1
    return at


@kernel
def word_start(text: NDArray[np.uint8], at: int, end: int) -> int:
    """Where the next word before `end` begins, or `end`."""
    while at < end and text[at] <= SPACE:
        at += 1
    return at


@kernel
def word_end(text: NDArray[np.uint8], at: int, end: int) -> int:
    """Where the word that begins at `at` ends."""
    while at < end and text[at] > SPACE:
        at += 1
    return at


@kernel
def number(text: NDArray[np.uint8], at: int, end: int) -> float:
    """Read a word as a decimal number; NaN if it is anything else, "nan" and "inf" included.

    Correctly rounded up to 15 digits with exponents within +-22 (Clinger, 1990), else within
    3 units in the last place of float64.
    """
    negative = at < end and text[at] == MINUS
    if at < end and (text[at] == MINUS or text[at] == PLUS):
        at += 1
    digits = 0
    kept, exponent, seen = 0, 0, 0
    fraction = False
    while at < end:
        if ZERO <= text[at] <= NINE:
            seen += 1
            if kept < _DIGITS_KEPT:
                digits = digits * 10 + (text[at] - ZERO)
                kept += 1 if digits > 0 else 0
                exponent -= 1 if fraction else 0
            else:
                exponent += 0 if fraction else 1
        elif text[at] == DOT and not fraction:
            fraction = True
        else:
            break
        at += 1
    if seen == 0:
        return np.nan
    if at < end:
        if text[at] != _LOWER_E and text[at] != _UPPER_E:
            return np.nan
        shift, at = integer(text, at + 1, end)
        if at != end:
            return np.nan
        exponent += shift
    value = float(digits)
    if exponent > 308:
        value = value * np.inf if digits > 0 else 0.0
    elif exponent >= 0:
        value *= _POWERS_OF_TEN[exponent]
    else:
        value /= _POWERS_OF_TEN[min(-exponent, 308)]
        value /= _POWERS_OF_TEN[min(max(-exponent - 308, 0), 308)]
    return -value if negative else value


@kernel
def integer(text: NDArray[np.uint8], at: int, end: int) -> tuple[int, int]:
    """Read as many digits as there are after an optional sign.

    Returns:
        The number, held within +-2^53, and where its last digit ends: -1 without any digit.
    """
    negative = at < end and text[at] == MINUS
    if at < end and (text[at] == MINUS or text[at] == PLUS):
        at += 1
    start = at
    value = 0
    while at < end and ZERO <= text[at] <= NINE:
        value = min(value * 10 + (text[at] - ZERO), _WHOLE_MAX)
        at += 1
    return (-value if negative else value), (at if at > start else -1)


@kernel
def count_words(text: NDArray[np.uint8]) -> tuple[int, int]:
    """Count the words of a text and the lines that have any."""
    words, lines = 0, 0
    inside, filled = False, False
    for byte in text:
        if byte > SPACE:
            words += 0 if inside else 1
            lines += 0 if filled else 1
            filled = True
        elif byte in (NEWLINE, RETURN):
            filled = False
        inside = byte > SPACE
    return words, lines


@kernel
def read_numbers(
    text: NDArray[np.uint8], numbers: NDArray[np.float64], lines: NDArray[np.int64]
) -> None:
    """Read all words of a text as numbers, NaN where one is none.

    Args:
        text: The text.
        numbers: (words,): filled.
        lines: (lines with words,): filled with the word that each begins with.
    """
    at, word, line = 0, 0, 0
    while at < len(text):
        end = line_end(text, at)
        at = word_start(text, at, end)
        if at < end:
            lines[line] = word
            line += 1
        while at < end:
            stop = word_end(text, at, end)
            numbers[word] = number(text, at, stop)
            word += 1
            at = word_start(text, stop, end)
        at = end + 1
