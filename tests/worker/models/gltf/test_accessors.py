"""Numbers out of buffers, against glTF 2.0, section 3.6.2, and the arithmetic of its formats."""

import struct
from typing import Any

import numpy as np
import pytest

from tests.worker.models.gltf.building import Builder, shown
from worker.errors import UnusableAssetError
from worker.models.gltf.accessors import Accessors
from worker.models.gltf.reader import check, read
from worker.models.gltf.resources import Resources


def numbers_of(builder: Builder, index: int, rows: Any = None) -> list[list[float]]:
    checked = check(builder.glb())
    found = Resources.find(checked.document, checked.container.binary, {})
    return Accessors(checked.document, found.buffers).numbers(index, rows).tolist()


def refused(builder: Builder, index: int = 0) -> UnusableAssetError:
    with pytest.raises(UnusableAssetError) as caught:
        numbers_of(builder, index)
    return caught.value


@pytest.mark.parametrize(
    ("dtype", "stored", "expected"),
    [
        ("<i1", [-128, -127, 0, 127], [-1.0, -1.0, 0.0, 1.0]),
        ("<u1", [0, 51, 255], [0.0, 0.2, 1.0]),
        ("<i2", [-32768, -32767, 32767], [-1.0, -1.0, 1.0]),
        ("<u2", [0, 13107, 65535], [0.0, 0.2, 1.0]),
    ],
)
def test_normalized_integers_are_fractions(
    dtype: str, stored: list[int], expected: list[float]
) -> None:
    builder = Builder()
    plain, normalized = builder.accessor(stored, dtype), builder.accessor(stored, dtype)
    builder.json["accessors"][normalized]["normalized"] = True

    assert numbers_of(builder, plain) == [[float(number)] for number in stored]
    assert numbers_of(builder, normalized) == [[number] for number in expected]


def test_interleaved_elements_are_picked_by_their_stride() -> None:
    builder = Builder()
    rows = [((1, 2, 3), 7), ((4, 5, 6), 8)]
    content = b"".join(struct.pack("<3fI", *point, code) for point, code in rows)
    view = builder.view(content, byteStride=16)
    builder.add(
        "accessors",
        {"bufferView": view, "componentType": 5126, "type": "VEC3", "count": 2},
    )
    builder.add(
        "accessors",
        {"bufferView": view, "byteOffset": 12, "componentType": 5125, "type": "SCALAR", "count": 2},
    )

    assert numbers_of(builder, 0) == [[1, 2, 3], [4, 5, 6]]
    assert numbers_of(builder, 1) == [[7], [8]]


def test_columns_of_small_matrices_begin_at_multiples_of_four() -> None:
    builder = Builder()
    view = builder.view(bytes([11, 12, 13, 0, 21, 22, 23, 0, 31, 32, 33, 0]))
    builder.add(
        "accessors", {"bufferView": view, "componentType": 5121, "type": "MAT3", "count": 1}
    )

    assert numbers_of(builder, 0) == [[11, 12, 13, 21, 22, 23, 31, 32, 33]]


def sparse(
    builder: Builder, indices: list[int], values: list[float], count: int, view: int | None
) -> int:
    accessor: dict[str, Any] = {
        "componentType": 5126,
        "type": "SCALAR",
        "count": count,
        "sparse": {
            "count": len(indices),
            "indices": {
                "bufferView": builder.view(np.array(indices, "<u2").tobytes()),
                "componentType": 5123,
            },
            "values": {"bufferView": builder.view(np.array(values, "<f4").tobytes())},
        },
    }
    if view is not None:
        accessor["bufferView"] = view
    return builder.add("accessors", accessor)


def test_sparse_values_replace_those_of_the_view_or_zeros() -> None:
    builder = Builder()
    view = builder.view(np.array([1, 2, 3, 4], "<f4").tobytes())
    over_view = sparse(builder, [1, 3], [20, 40], 4, view)
    over_nothing = sparse(builder, [0, 2], [5, 6], 4, None)
    nothing = builder.add("accessors", {"componentType": 5126, "type": "VEC2", "count": 2})

    assert numbers_of(builder, over_view) == [[1], [20], [3], [40]]
    assert numbers_of(builder, over_nothing) == [[5], [0], [6], [0]]
    assert numbers_of(builder, nothing) == [[0, 0], [0, 0]]
    assert numbers_of(builder, over_view, np.array([3, 0, 3, 2])) == [[40], [1], [40], [3]]


@pytest.mark.parametrize(
    ("indices", "word"), [([1, 1], "increase"), ([2, 1], "increase"), ([0, 4], "not below 4")]
)
def test_sparse_indices_must_increase_and_stay_inside(indices: list[int], word: str) -> None:
    builder = Builder()
    index = sparse(builder, indices, [5, 6], 4, None)

    error = refused(builder, index)
    assert word in error.message
    assert error.message.startswith("/accessors/0/sparse/indices: ")


@pytest.mark.parametrize("bad", [np.nan, np.inf, -np.inf])
def test_numbers_that_are_none_are_refused_where_they_stand(bad: float) -> None:
    builder = Builder()
    builder.accessor([[0, 0, 0], [0, bad, 0]])

    assert refused(builder).message == "/accessors/0: element 1 is not finite"


def test_a_signalling_nan_is_one_more_that_is_not_finite() -> None:
    """numpy warns of it when it becomes a float64."""
    builder = Builder()
    builder.accessor(np.zeros((2, 3), "<f4"))
    builder.binary[-4:] = struct.pack("<I", 0x7F800001)

    assert refused(builder).message == "/accessors/0: element 1 is not finite"


@pytest.mark.parametrize(
    ("change", "word"),
    [
        ({"count": 4}, "ends at byte 48 of a view of 36"),
        ({"byteOffset": 4}, "ends at byte 40 of a view of 36"),
        ({"byteOffset": 2}, "no multiple of 4"),
        ({"byteOffset": -4}, "greater than or equal to 0"),
        ({"count": 0}, "greater than or equal to 1"),
        ({"count": -1}, "greater than or equal to 1"),
        ({"count": 1.5}, "valid integer"),
        ({"count": "3"}, "valid integer"),
        ({"count": None}, "null"),
        ({"bufferView": 1}, "index 1 is not below 1"),
        ({"normalized": True}, "normalized"),
        ({"min": [0, 0]}, "2 numbers for 3"),
        ({"max": [0, 0, 1e39]}, "less than or equal to"),
    ],
)
def test_an_accessor_that_cannot_be_is_refused(change: dict[str, Any], word: str) -> None:
    builder = Builder()
    builder.accessor([[0, 0, 0], [1, 0, 0], [0, 1, 0]])
    builder.json["accessors"][0] |= change

    error = refused(builder)
    assert error.code == "asset_unusable"
    assert word in error.message
    assert error.message.startswith("/accessors/0")


@pytest.mark.parametrize(
    ("change", "word"),
    [
        ({"byteLength": 37}, "ends at byte 37 of a buffer of 36"),
        ({"byteOffset": 4}, "ends at byte 40 of a buffer of 36"),
        ({"byteStride": 40}, "more than byteLength"),
        ({"byteStride": 14}, "multiple of 4"),
        ({"byteStride": 8}, "less than the 12 needed"),
        ({"buffer": 1}, "not below 1"),
    ],
)
def test_a_view_that_cannot_be_is_refused(change: dict[str, Any], word: str) -> None:
    builder = Builder()
    builder.accessor([[0, 0, 0], [1, 0, 0], [0, 1, 0]])
    builder.json["bufferViews"][0] |= change

    assert word in refused(builder).message


def test_views_and_offsets_must_add_up_to_multiples_of_the_component() -> None:
    builder = Builder()
    builder.view(bytes(16))
    builder.json["bufferViews"][0] |= {"byteOffset": 2, "byteLength": 14}
    item = {"bufferView": 0, "componentType": 5126, "type": "VEC3", "count": 1}
    builder.add("accessors", item)

    assert refused(builder).message == "/accessors/0: it begins at no multiple of 4 bytes"


def test_a_matrix_of_bytes_begins_at_a_multiple_of_four() -> None:
    builder = Builder()
    view = builder.view(bytes(16))
    item = {"bufferView": view, "componentType": 5121, "type": "MAT3", "count": 1, "byteOffset": 2}
    builder.add("accessors", item)

    assert refused(builder).message.startswith("/accessors/0/byteOffset: a matrix")


def test_no_more_elements_can_be_replaced_than_there_are() -> None:
    builder = Builder()
    index = sparse(builder, [0, 1, 2], [5, 6, 7], 2, None)

    assert "3 is more than all 2" in refused(builder, index).message


@pytest.mark.parametrize("part", ["indices", "values"])
def test_a_sparse_part_must_fit_its_view(part: str) -> None:
    builder = Builder()
    index = sparse(builder, [0, 1], [5, 6], 4, None)
    builder.json["accessors"][index]["sparse"][part]["byteOffset"] = 4

    assert refused(builder, index).message.startswith(f"/accessors/0/sparse/{part}: it ends")


def test_a_buffer_that_is_shorter_than_it_says_is_refused() -> None:
    builder = Builder()
    builder.mesh()
    text, content = builder.separate()

    with pytest.raises(UnusableAssetError, match="36 bytes are claimed where there are 35"):
        read(text, {"shape.bin": content[:-1]})


def test_a_type_that_gltf_does_not_have_is_refused_where_it_is_used() -> None:
    builder = Builder()
    builder.accessor([[0, 0, 0]])
    builder.json["accessors"][0]["type"] = "VEC5"
    check(builder.glb())
    builder.json |= shown(builder.add("meshes", {"primitives": [{"attributes": {"POSITION": 0}}]}))

    with pytest.raises(UnusableAssetError, match="/meshes/0/primitives/0/attributes/POSITION"):
        check(builder.glb())


def test_quantized_attributes_need_their_extension() -> None:
    builder = Builder()
    position = builder.accessor([[0, 0, 0], [100, 0, 0], [0, 50, 0]], "<u2")
    builder.json["bufferViews"][0]["byteLength"] = 18
    mesh = builder.add("meshes", {"primitives": [{"attributes": {"POSITION": position}}]})
    builder.json |= {"nodes": [{"mesh": mesh, "scale": [0.01, 0.01, 0.01]}]}

    with pytest.raises(UnusableAssetError, match="format"):
        read(builder.glb(), {})
    builder.json["extensionsUsed"] = builder.json["extensionsRequired"] = ["KHR_mesh_quantization"]
    (part,) = read(builder.glb(), {}).parts

    assert part.mesh.positions.tolist() == [[0, 0, 0], [100, 0, 0], [0, 50, 0]]
    assert np.diag(part.matrix).tolist() == [0.01, 0.01, 0.01, 1]
