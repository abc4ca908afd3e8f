"""The numbers of a PLY file, element by element."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from worker.errors import UnusableAssetError
from worker.geometry.model_limits import TRIANGLES_MAX, VERTICES_MAX, check_size
from worker.geometry.text import count_words, read_numbers
from worker.numba_kernel import kernel

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from worker.geometry.ply_header import Element, Header, Property


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


def read_body(data: bytes, header: Header, wanted: frozenset[str]) -> dict[str, Table]:
    """Read the elements whose names are wanted.

    Raises:
        UnusableAssetError: `asset_unusable` if there is less than the header claims, or
            `asset_too_large`.
    """
    tables: dict[str, Table] = {}
    is_text = header.encoding == "ascii"
    units = _words(data, header) if is_text else np.frombuffer(data, np.uint8)[header.length :]
    at = 0
    for element in header.elements:
        if len(tables) == len(wanted):
            break
        if element.name in wanted:
            check_size(element.rows, VERTICES_MAX, "rows")
        if element.rows * _smallest(element, is_text) > len(units) - at:
            raise UnusableAssetError("it holds fewer numbers than its header claims")
        read = _read_text_element if is_text else _read_binary_element
        table, at = read(units, at, element)
        if element.name in wanted:
            tables.setdefault(element.name, table)
    return tables


def _words(data: bytes, header: Header) -> NDArray[np.float64]:
    text = np.frombuffer(data, np.uint8)[header.length :]
    words = int(count_words(text))
    check_size(words, 16 * VERTICES_MAX, "numbers")
    numbers = np.empty(words)
    read_numbers(text, numbers)
    return numbers


def _smallest(element: Element, is_text: bool) -> int:
    """The least number of units that a row takes: words of a text, or bytes."""
    if is_text:
        return len(element.properties)
    return sum((p.count or p.type).itemsize for p in element.properties)
