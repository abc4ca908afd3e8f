"""Where numbers lie: buffers, views of them, accessors."""

from typing import Annotated, Self

from pydantic import Field, model_validator

from worker.models.gltf.document.base import Code, Count, GltfObject, Index, Named, Offset, Real

Bounds = Annotated[list[Real], Field(min_length=1, max_length=16)]


class Buffer(Named):
    """Bytes: the binary chunk, a data URI or a file beside the asset."""

    uri: str | None = None
    byte_length: Count


class BufferView(Named):
    """A part of a buffer."""

    buffer: Index
    byte_offset: Offset = 0
    byte_length: Count
    byte_stride: Annotated[int, Field(ge=4, le=252, multiple_of=4)] | None = None


class SparseIndices(GltfObject):
    """Which elements a sparse accessor replaces."""

    buffer_view: Index
    byte_offset: Offset = 0
    component_type: Code


class SparseValues(GltfObject):
    """What it puts there."""

    buffer_view: Index
    byte_offset: Offset = 0


class Sparse(GltfObject):
    """A few elements that differ from the rest."""

    count: Count
    indices: SparseIndices
    values: SparseValues


class Accessor(Named):
    """A part of a buffer view as numbers; without a view all are zero."""

    buffer_view: Index | None = None
    byte_offset: Offset = 0
    component_type: Code
    normalized: bool = False
    count: Count
    type: str
    min: Bounds | None = None
    max: Bounds | None = None
    sparse: Sparse | None = None

    @model_validator(mode="after")
    def _offset_needs_view(self) -> Self:
        if self.buffer_view is None and "byte_offset" in self.model_fields_set:
            raise ValueError("byteOffset needs a bufferView")
        return self
