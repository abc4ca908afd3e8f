"""The numbers of a PLY file, element by element."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from worker.errors import UnusableAssetError
from worker.geometry.model_limits import VERTICES_MAX, check_size
from worker.geometry.text import count_words, read_numbers
from worker.numba_kernel import kernel

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from worker.geometry.ply_header import Element, Header, Property

# Of elements that are read row by row; other properties are stepped over.
_KEPT = {"x", "y", "z", "nx", "ny", "nz", "red", "green", "blue", "alpha", "vertex1", "vertex2"}
_KEPT |= {"s", "t", "u", "v", "texture_u", "texture_v", "texture_s", "texture_t"}
_KEPT |= {"vertex_indices", "vertex_index", "texcoord"}


@dataclass(frozen=True, slots=True)
class Lists:
    """The lists of one property: all items, one list after the other."""

    items: NDArray[np.float64]
    starts: NDArray[np.int64]

    @property
    def sizes(self) -> NDArray[np.int64]:
        """How many items each list has."""
        return np.diff(self.starts)


@dataclass(frozen=True, slots=True)
class Table:
    """One element: its columns and its lists by the names of their properties."""

    rows: int
    columns: dict[str, NDArray[np.float64]]
    lists: dict[str, Lists]


@dataclass(frozen=True, slots=True)
class _Body:
    """Everything after the header: words of a text as numbers, or bytes.

    Attributes:
        units: The words or bytes.
        line_starts: The word that each line begins with, and the end, where every row of the file
            is a line: then a line may be longer than its row. Empty otherwise.
        is_text: Whether they are words.
    """

    units: NDArray[np.float64] | NDArray[np.uint8]
    line_starts: NDArray[np.int64]
    is_text: bool


# A float32 NaN may be a signalling one, which numpy tells of when it becomes a float64.
@np.errstate(invalid="ignore")
def read_body(data: bytes, header: Header, wanted: frozenset[str]) -> dict[str, Table]:
    """Read the elements whose names are wanted.

    Raises:
        UnusableAssetError: `asset_unusable` if there is less than the header claims, or
            `asset_too_large`.
    """
    body = _body(data, header)
    tables: dict[str, Table] = {}
    at, row = 0, 0
    for element in header.elements:
        if len(tables) == len(wanted):
            break
        if element.name in wanted:
            check_size(element.rows, VERTICES_MAX, "rows")
        if element.rows * _smallest(element, body) > len(body.units) - at:
            raise UnusableAssetError("it holds fewer numbers than its header claims")
        own_lines = body.line_starts[row : row + element.rows + 1]
        if element.has_lists or len(own_lines):
            table, at = _read_rows(body, at, element, own_lines)
        else:
            table, at = _read_columns(body, at, element)
        row += element.rows
        if element.name in wanted:
            tables.setdefault(element.name, table)
    return tables


def _body(data: bytes, header: Header) -> _Body:
    content = np.frombuffer(data, np.uint8)[header.length :]
    if header.encoding != "ascii":
        return _Body(content, np.empty(0, np.int64), is_text=False)
    words, lines = count_words(content)
    check_size(words, 8 * VERTICES_MAX, "numbers")
    numbers = np.empty(words)
    starts = np.empty(lines + 1, np.int64)
    read_numbers(content, numbers, starts)
    starts[-1] = words
    is_by_line = lines == sum(element.rows for element in header.elements)
    return _Body(numbers, starts if is_by_line else starts[:0], is_text=True)


def _smallest(element: Element, body: _Body) -> int:
    """The least number of units that a row takes."""
    if body.is_text:
        return len(element.properties)
    return sum((p.count or p.type).itemsize for p in element.properties)


def _read_columns(body: _Body, at: int, element: Element) -> tuple[Table, int]:
    """Read an element whose rows are all alike."""
    types = [
        (str(i), np.float64 if body.is_text else p.type) for i, p in enumerate(element.properties)
    ]
    row = np.dtype(types)
    end = at + element.rows * _smallest(element, body)
    rows = body.units[at:end].view(row) if types else np.empty(0, row)
    columns = {p.name: rows[str(i)].astype(np.float64) for i, p in enumerate(element.properties)}
    return Table(element.rows, columns, {}), end


def _read_rows(
    body: _Body, at: int, element: Element, line_starts: NDArray[np.int64]
) -> tuple[Table, int]:
    """Read an element row by row, since they differ in length."""
    kept = [p for p in element.properties if p.name in _KEPT]
    slots = np.array([kept.index(p) if p in kept else -1 for p in element.properties], np.int64)
    sizes = np.array([1 if body.is_text else p.type.itemsize for p in element.properties], np.int64)
    lengths = np.array(
        [
            0 if p.count is None else 1 if body.is_text else p.count.itemsize
            for p in element.properties
        ],
        np.int64,
    )
    starts = np.empty((element.rows, len(kept)), np.int64)
    counts = np.empty((element.rows, len(kept)), np.int32)
    is_big = any(p.count is not None and p.count.byteorder == ">" for p in element.properties)
    end = _walk(body.units, at, line_starts, lengths, sizes, slots, starts, counts, is_big)
    if end < 0:
        raise UnusableAssetError("a row in it is longer than what is there")
    columns: dict[str, NDArray[np.float64]] = {}
    lists: dict[str, Lists] = {}
    for slot, kept_property in enumerate(kept):
        items = _gather(body, starts[:, slot], counts[:, slot], kept_property)
        if kept_property.count is None:
            columns[kept_property.name] = items
        else:
            begins = np.zeros(element.rows + 1, np.int64)
            np.cumsum(counts[:, slot], out=begins[1:])
            lists[kept_property.name] = Lists(items, begins)
    return Table(element.rows, columns, lists), end


def _gather(
    body: _Body, starts: NDArray[np.int64], counts: NDArray[np.int32], kept: Property
) -> NDArray[np.float64]:
    size = 1 if body.is_text else kept.type.itemsize
    gathered = np.empty(int(counts.sum(dtype=np.int64)) * size, body.units.dtype)
    _copy(body.units, starts, counts, size, gathered)
    numbers = gathered if body.is_text else gathered.view(kept.type)
    return np.asarray(numbers, np.float64)


@kernel
def _walk(
    units: NDArray[np.float64] | NDArray[np.uint8],
    at: int,
    line_starts: NDArray[np.int64],
    lengths: NDArray[np.int64],
    sizes: NDArray[np.int64],
    slots: NDArray[np.int64],
    starts: NDArray[np.int64],
    counts: NDArray[np.int32],
    is_big: bool,
) -> int:
    """Find where the kept numbers of each row begin, and how many there are.

    Args:
        units: Words of a text as numbers, or bytes.
        at: Where the first row begins.
        line_starts: (rows + 1,): where each row begins and must have ended; or empty.
        lengths: (p,): units of the length in front of each list; 0 is no list.
        sizes: (p,): units of each number.
        slots: (p,): the column of `starts` for each property; -1 is not kept.
        starts: (rows, s): filled.
        counts: (rows, s): filled.
        is_big: Whether the first byte of a length is the highest.

    Returns:
        Where the last row ends; -1 if one is longer than its line or goes beyond the last unit.
    """
    by_line = len(line_starts) > 0
    for row in range(len(starts)):
        if by_line:
            at = line_starts[row]
        limit = line_starts[row + 1] if by_line else len(units)
        for column in range(len(sizes)):
            count = 1
            length = lengths[column]
            if at + length > limit:
                return -1
            if length > 0:
                count = 0
                for k in range(length):
                    unit = units[at + k]
                    if not 0 <= unit <= 2**31:
                        return -1
                    shift = 8 * (length - 1 - k if is_big else k)
                    count += int(unit) << shift
                at += length
            if count * sizes[column] > limit - at:
                return -1
            if slots[column] >= 0:
                starts[row, slots[column]] = at
                counts[row, slots[column]] = count
            at += count * sizes[column]
    return line_starts[len(starts)] if by_line else at


@kernel
def _copy(
    units: NDArray[np.float64] | NDArray[np.uint8],
    starts: NDArray[np.int64],
    counts: NDArray[np.int32],
    size: int,
    out: NDArray[np.float64] | NDArray[np.uint8],
) -> None:
    filled = 0
    for row in range(len(starts)):
        for k in range(counts[row] * size):
            out[filled] = units[starts[row] + k]
            filled += 1
