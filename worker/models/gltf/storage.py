"""Whether every view lies in its buffer and every accessor in its view: sums, no data needed."""

from worker.models.gltf.accessor_types import COMPONENTS, FLOAT, Element, element_of
from worker.models.gltf.document.data import Accessor, BufferView
from worker.models.gltf.document.root import Document
from worker.models.gltf.faults import too_large, unusable
from worker.models.gltf.limits import ELEMENTS_MAX

_UNSIGNED_INT = 5125
_SPARSE_INDEX_TYPES = frozenset({5121, 5123, 5125})


def check_storage(document: Document) -> None:
    """Check buffer views, accessors and the views of pictures.

    Accessors of types that glTF does not have pass here, and are refused where they are used.

    Raises:
        UnusableAssetError: Something reaches beyond what holds it, is aligned or strided as glTF
            forbids (`asset_unusable`), or has too many elements (`asset_too_large`).
    """
    for index, view in enumerate(document.buffer_views):
        _check_view(document, view, f"/bufferViews/{index}")
    for index, accessor in enumerate(document.accessors):
        _check_accessor(document, accessor, f"/accessors/{index}")
    for index, image in enumerate(document.images):
        if (
            image.buffer_view is not None
            and document.buffer_views[image.buffer_view].byte_stride is not None
        ):
            raise unusable(f"/images/{index}/bufferView", "a view with a byteStride is no picture")


def _check_view(document: Document, view: BufferView, place: str) -> None:
    length = document.buffers[view.buffer].byte_length
    if view.byte_offset + view.byte_length > length:
        raise unusable(
            place,
            f"it ends at byte {view.byte_offset + view.byte_length} of a buffer of {length}",
        )
    if view.byte_stride is not None and view.byte_stride > view.byte_length:
        raise unusable(place, "byteStride is more than byteLength")


def _check_accessor(document: Document, accessor: Accessor, place: str) -> None:
    element = element_of(accessor.component_type, accessor.type)
    if element is None:
        return
    if accessor.count > ELEMENTS_MAX:
        raise too_large(place, f"{accessor.count} elements; at most {ELEMENTS_MAX} are taken")
    if accessor.normalized and accessor.component_type in (FLOAT, _UNSIGNED_INT):
        raise unusable(place, "only 8 and 16 bit integers can be normalized")
    for name, bound in (("min", accessor.min), ("max", accessor.max)):
        if bound is not None and len(bound) != element.numbers:
            raise unusable(f"{place}/{name}", f"{len(bound)} numbers for {element.numbers}")
    if accessor.buffer_view is not None:
        view = document.buffer_views[accessor.buffer_view]
        if element.columns > 1 and accessor.byte_offset % 4:
            raise unusable(f"{place}/byteOffset", "a matrix must begin at a multiple of 4")
        if view.byte_stride is not None and view.byte_stride < element.size_bytes:
            raise unusable(
                place, f"byteStride {view.byte_stride} is less than the {element.size_bytes} needed"
            )
        stride = view.byte_stride or element.size_bytes
        _check_fit(view, accessor.byte_offset, element, stride, accessor.count, place)
    if accessor.sparse is not None:
        _check_sparse(document, accessor, element, f"{place}/sparse")


def _check_sparse(document: Document, accessor: Accessor, element: Element, place: str) -> None:
    sparse = accessor.sparse
    if sparse is None:
        return
    if sparse.count > accessor.count:
        raise unusable(f"{place}/count", f"{sparse.count} is more than all {accessor.count}")
    kind = sparse.indices.component_type
    if kind not in _SPARSE_INDEX_TYPES:
        raise unusable(f"{place}/indices/componentType", "indices must be unsigned integers")
    index_element = Element(COMPONENTS[kind], 1, 1)
    for name, part, one in (
        ("indices", sparse.indices, index_element),
        ("values", sparse.values, element),
    ):
        view = document.buffer_views[part.buffer_view]
        if view.byte_stride is not None:
            raise unusable(f"{place}/{name}/bufferView", "a sparse part's view has no byteStride")
        _check_fit(view, part.byte_offset, one, one.size_bytes, sparse.count, f"{place}/{name}")


def _check_fit(
    view: BufferView, offset: int, element: Element, stride: int, count: int, place: str
) -> None:
    if offset % element.component.itemsize:
        raise unusable(f"{place}/byteOffset", f"it is no multiple of {element.component.itemsize}")
    if (view.byte_offset + offset) % element.component.itemsize:
        raise unusable(place, f"it begins at no multiple of {element.component.itemsize} bytes")
    end = offset + stride * (count - 1) + element.size_bytes
    if end > view.byte_length:
        raise unusable(place, f"it ends at byte {end} of a view of {view.byte_length}")
