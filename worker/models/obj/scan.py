"""Kernels that take the statements of an OBJ file apart.

Two walks over the text: the first counts, the second fills arrays of just that size.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

import numpy as np

from worker.models.text import (
    HASH,
    NEWLINE,
    SLASH,
    integer,
    line_end,
    number,
    word_end,
    word_start,
)
from worker.numba_kernel import kernel

if TYPE_CHECKING:
    from numpy.typing import NDArray

(
    OTHER,
    VERTEX,
    TEXTURE_VERTEX,
    NORMAL,
    FACE,
    LINE,
    POINT,
    SMOOTHING,
    MATERIAL,
    GROUP,
    LIBRARY,
    FREE_FORM,
) = range(12)

CORNERS: Final = 12
"""Where `count` puts the number of corners of all faces, lines and points."""

LIBRARIES_MAX: Final = 64

NOT_AN_INDEX: Final = 1
NO_SUCH_VERTEX: Final = 2

_V, _T, _N, _F, _O, _L, _P, _S, _G = b"vtnfolpsg"


@kernel
def _is(text: NDArray[np.uint8], start: int, end: int, word: bytes) -> bool:
    index = 0
    while index < min(end - start, len(word)) and text[start + index] == word[index]:
        index += 1
    return index == end - start == len(word)


@kernel
def _kind(text: NDArray[np.uint8], start: int, end: int) -> int:
    """Which statement a word begins."""
    first = text[start]
    if end - start == 1:
        if first == _V:
            return VERTEX
        if first == _F:
            return FACE
        if first == _L:
            return LINE
        if first == _P:
            return POINT
        if first == _S:
            return SMOOTHING
        if first in (_G, _O):
            return GROUP
        return OTHER
    if end - start == 2:
        if first == _V and text[start + 1] == _T:
            return TEXTURE_VERTEX
        if first == _V and text[start + 1] == _N:
            return NORMAL
        if first == _F and text[start + 1] == _O:  # a face, before version 3
            return FACE
        return OTHER
    if _is(text, start, end, b"usemtl"):
        return MATERIAL
    if _is(text, start, end, b"mtllib"):
        return LIBRARY
    if _is(text, start, end, b"curv") or _is(text, start, end, b"surf"):
        return FREE_FORM
    return OTHER


@kernel
def count(text: NDArray[np.uint8]) -> NDArray[np.int64]:
    """Count the statements of each kind, and at `CORNERS` the corners; a kind is an index."""
    counts = np.zeros(CORNERS + 1, np.int64)
    at = 0
    while at < len(text):
        end = line_end(text, at)
        at = word_start(text, at, end)
        if at < end and text[at] != HASH:
            stop = word_end(text, at, end)
            kind = _kind(text, at, stop)
            counts[kind] += 1
            if kind in (FACE, LINE, POINT):
                counts[CORNERS] += _count_words_of_line(text, stop, end)
        at = end + 1
    return counts


@kernel
def _count_words_of_line(text: NDArray[np.uint8], at: int, end: int) -> int:
    words = 0
    at = word_start(text, at, end)
    while at < end and text[at] != HASH:
        words += 1
        at = word_start(text, word_end(text, at, end), end)
    return words


@kernel
def fill(
    text: NDArray[np.uint8],
    vertices: NDArray[np.float64],
    texture_vertices: NDArray[np.float64],
    normals: NDArray[np.float64],
    corners: NDArray[np.int32],
    elements: NDArray[np.int32],
    marks: NDArray[np.int64],
    libraries: NDArray[np.int64],
) -> tuple[int, int, int]:
    """Read all statements.

    Args:
        text: The file.
        vertices: (n, 7): x, y, z, red, green, blue and how many numbers there were.
        texture_vertices: (n, 2).
        normals: (n, 3).
        corners: (n, 3): indices of vertex, texture vertex and normal, from 0 on; -1 is none.
        elements: (n, 5): its kind, its first corner, its smoothing group, and which of `marks`
            names its material and its group, -1 being none.
        marks: (n, 2): where the words after usemtl, g and o begin and end; only those are written
            that an element follows.
        libraries: (n, 2): the same of mtllib.

    Returns:
        What is wrong (0 if nothing), the number of the line, and how many marks were written.
    """
    counted = np.zeros(3, np.int64)
    totals = np.array([len(vertices), len(texture_vertices), len(normals)])
    corner, element, mark, library = 0, 0, 0, 0
    smoothing = -1
    material_start, material_stop, material = -1, -1, -1
    group_start, group_stop, group = -1, -1, -1
    line = 0
    at = 0
    while at < len(text):
        end = line_end(text, at)
        line += 1 if end == len(text) or text[end] == NEWLINE else 0
        at = word_start(text, at, end)
        if at == end or text[at] == HASH:
            at = end + 1
            continue
        stop = word_end(text, at, end)
        kind = _kind(text, at, stop)
        at = word_start(text, stop, end)
        if kind == VERTEX:
            found = _read_row(text, at, end, vertices[counted[0], :6])
            vertices[counted[0], 6] = found
            counted[0] += 1
        elif kind == TEXTURE_VERTEX:
            found = _read_row(text, at, end, texture_vertices[counted[1]])
            if found == 1:
                texture_vertices[counted[1], 1] = 0.0
            counted[1] += 1
        elif kind == NORMAL:
            _read_row(text, at, end, normals[counted[2]])
            counted[2] += 1
        elif kind in (FACE, LINE, POINT):
            if material_start >= 0:
                marks[mark, 0], marks[mark, 1] = material_start, material_stop
                material, material_start = mark, -1
                mark += 1
            if group_start >= 0:
                marks[mark, 0], marks[mark, 1] = group_start, group_stop
                group, group_start = mark, -1
                mark += 1
            elements[element, 0], elements[element, 1] = kind, corner
            elements[element, 2] = smoothing
            elements[element, 3], elements[element, 4] = material, group
            element += 1
            while at < end and text[at] != HASH:
                stop = word_end(text, at, end)
                wrong = _read_corner(text, at, stop, counted, totals, corners[corner])
                if wrong != 0:
                    return wrong, line, mark
                corner += 1
                at = word_start(text, stop, end)
        elif kind == SMOOTHING:
            value, stop = integer(text, at, end)
            smoothing = value % 2**31 if stop > 0 else 0
        elif kind == MATERIAL:
            material_start, material_stop = at, end
        elif kind == GROUP:
            group_start, group_stop = at, end
        elif kind == LIBRARY and library < len(libraries):
            libraries[library, 0], libraries[library, 1] = at, end
            library += 1
        at = end + 1
    return 0, line, mark


@kernel
def _read_row(text: NDArray[np.uint8], at: int, end: int, row: NDArray[np.float64]) -> int:
    """Fill a row with the numbers of a line, NaN where there are too few; return how many."""
    found = 0
    for index in range(len(row)):
        if at < end and text[at] == HASH:
            at = end
        if at == end:
            row[index] = np.nan
            continue
        stop = word_end(text, at, end)
        row[index] = number(text, at, stop)
        found += 1
        at = word_start(text, stop, end)
    return found


@kernel
def _read_corner(
    text: NDArray[np.uint8],
    at: int,
    end: int,
    counted: NDArray[np.int64],
    totals: NDArray[np.int64],
    corner: NDArray[np.int32],
) -> int:
    """Read v, v/vt, v//vn or v/vt/vn; numbers below 0 count back from what was read so far.

    A texture vertex or a normal that is not there is none: exporters write such files.
    """
    corner[:] = -1
    for part in range(3):
        value, stop = integer(text, at, end)
        if stop < 0:
            if part == 0:
                return NOT_AN_INDEX
            stop = at
        else:
            index = value - 1 if value > 0 else counted[part] + value
            if value != 0 and 0 <= index < totals[part]:
                corner[part] = index
            elif part == 0:
                return NO_SUCH_VERTEX
        if stop == end:
            return 0
        if text[stop] != SLASH:
            return NOT_AN_INDEX
        at = stop + 1
    return NOT_AN_INDEX
