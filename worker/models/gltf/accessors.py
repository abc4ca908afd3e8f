"""Numbers out of buffers. Views that `storage` has found sound are read without a copy."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from worker.models.gltf.accessor_types import COMPONENTS, Element, element_of
from worker.models.gltf.document.data import Accessor
from worker.models.gltf.document.root import Document
from worker.models.gltf.faults import unusable

Rows = NDArray[np.int64]


class Accessors:
    """A document's accessors, by index. Work and memory grow with the rows asked for alone."""

    def __init__(self, document: Document, buffers: tuple[memoryview | None, ...]) -> None:
        """Read from buffers that are as long as the document says, None where there is no data."""
        self._document = document
        self._buffers = buffers
        self._sparse: dict[int, tuple[Rows, NDArray[Any]]] = {}

    def numbers(self, index: int, rows: Rows | None = None) -> NDArray[np.float64]:
        """Read elements as numbers, normalized integers as -1..1 or 0..1.

        Args:
            index: Of the accessor.
            rows: Which elements; all without.

        Returns:
            float64 (number of rows, components), matrices column by column.

        Raises:
            UnusableAssetError: One is not finite, or the data are missing.
        """
        accessor = self._document.accessors[index]
        raw = self.raw(index, rows)
        with np.errstate(invalid="ignore"):  # a NaN may be a signalling one
            values = raw.astype(np.float64)
        if raw.dtype.kind == "f":
            good = np.isfinite(values)
            if not good.all():
                row = int(np.argmin(good.all(axis=1)))
                element = row if rows is None else int(rows[row])
                raise unusable(f"/accessors/{index}", f"element {element} is not finite")
        elif accessor.normalized:
            values /= np.iinfo(raw.dtype).max
            np.maximum(values, -1.0, out=values)
        return values

    def raw(self, index: int, rows: Rows | None = None) -> NDArray[Any]:
        """Read elements as they are stored: (number of rows, components)."""
        accessor = self._document.accessors[index]
        element = self._element(index)
        if accessor.buffer_view is None:
            length = accessor.count if rows is None else len(rows)
            values = np.zeros((length, element.numbers), element.component)
        else:
            view = self._view(accessor.buffer_view, accessor.byte_offset, element, accessor.count)
            picked = view if rows is None else view[rows]
            values = picked.reshape(len(picked), element.numbers)
        if accessor.sparse is None:
            return values
        return self._replaced(index, accessor, values, rows)

    def _replaced(
        self, index: int, accessor: Accessor, values: NDArray[Any], rows: Rows | None
    ) -> NDArray[Any]:
        if index not in self._sparse:
            self._sparse[index] = self._read_sparse(index, accessor)
        places, replacements = self._sparse[index]
        values = values.copy()
        if rows is None:
            values[places] = replacements
            return values
        found = np.minimum(np.searchsorted(places, rows), len(places) - 1)
        hit = places[found] == rows
        values[hit] = replacements[found[hit]]
        return values

    def _read_sparse(self, index: int, accessor: Accessor) -> tuple[Rows, NDArray[Any]]:
        sparse = accessor.sparse
        if sparse is None:
            raise ValueError("the accessor is not sparse")
        element = self._element(index)
        kind = Element(COMPONENTS[sparse.indices.component_type], 1, 1)
        places = self._view(
            sparse.indices.buffer_view, sparse.indices.byte_offset, kind, sparse.count
        )
        places = places.reshape(-1).astype(np.int64)
        place = f"/accessors/{index}/sparse/indices"
        if (np.diff(places) <= 0).any():
            raise unusable(place, "the indices do not increase")
        if places[-1] >= accessor.count:
            raise unusable(place, f"index {places[-1]} is not below {accessor.count}")
        values = self._view(
            sparse.values.buffer_view, sparse.values.byte_offset, element, sparse.count
        )
        return places, values.reshape(sparse.count, element.numbers)

    def _view(self, view_index: int, offset: int, element: Element, count: int) -> NDArray[Any]:
        """Lay an array over the bytes: (count, columns, rows), read-only."""
        view = self._document.buffer_views[view_index]
        buffer = self._buffers[view.buffer]
        if buffer is None:
            raise unusable(f"/buffers/{view.buffer}", "the buffer has no data")
        stride = view.byte_stride or element.size_bytes
        return np.ndarray(
            shape=(count, element.columns, element.rows),
            dtype=element.component,
            buffer=buffer,
            offset=view.byte_offset + offset,
            strides=(stride, element.column_bytes, element.component.itemsize),
        )

    def _element(self, index: int) -> Element:
        accessor = self._document.accessors[index]
        element = element_of(accessor.component_type, accessor.type)
        if element is None:
            raise unusable(f"/accessors/{index}", "its type or componentType is not one of glTF's")
        return element
