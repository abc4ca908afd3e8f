"""Small files that ask for much: refused by name, at once, before memory is taken.

The recipes glTF-1 to glTF-4 of the corpus' BOMB_RECIPES.txt are built here, or in test_resources.
"""

import json
import time
import tracemalloc
from typing import Any

import numpy as np
import pytest

from tests.worker.models.gltf.building import TRIANGLE, Builder, glb, shown
from worker.errors import UnusableAssetError
from worker.models.gltf.reader import read

SECONDS = 10.0  # on a machine that does other things too; alone it takes a second
MEMORY = 64 * 2**20


def refused(data: bytes) -> UnusableAssetError:
    tracemalloc.start()
    started = time.monotonic()
    with pytest.raises(UnusableAssetError) as caught:
        read(data, {})
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    assert time.monotonic() - started < SECONDS  # with the tracing, which costs a multiple
    assert peak < MEMORY + 8 * len(data)
    return caught.value


def test_gltf_1_four_billion_vertices_in_48_bytes() -> None:
    builder = Builder()
    view = builder.view(bytes(48))
    item = {"componentType": 5126, "type": "VEC3", "count": 2**32 - 1}
    builder.add("accessors", {**item, "bufferView": view, "count": 10**9})
    builder.json |= shown(builder.add("meshes", {"primitives": [{"attributes": {"POSITION": 0}}]}))

    assert refused(builder.glb()).code == "asset_too_large"
    builder.json["accessors"][0]["count"] = 5_000_000
    assert "ends at byte 60000000 of a view of 48" in refused(builder.glb()).message
    builder.json["accessors"][0] = item
    assert refused(builder.glb()).code == "asset_too_large"
    item["count"] = 3 * 2_800_000
    assert "vertices; at most 8388608" in refused(builder.glb()).message


def test_many_attributes_of_vertices_that_are_nowhere_are_counted_in_bytes() -> None:
    builder = Builder()
    four = builder.add("accessors", {"componentType": 5126, "type": "VEC4", "count": 5_000_000})
    three = builder.add("accessors", {"componentType": 5126, "type": "VEC3", "count": 5_000_000})
    attributes = {"POSITION": three, "NORMAL": three, "TANGENT": four, "COLOR_0": four}
    builder.json |= shown(builder.add("meshes", {"primitives": [{"attributes": attributes}]}))

    assert f"{5_000_000 * 14 * 8} bytes of vertices" in refused(builder.glb()).message


def test_gltf_2_a_data_uri_of_200_megabytes() -> None:
    head = '{"asset":{"version":"2.0"},"buffers":[{"byteLength":157286400,"uri":"data:;base64,'
    text = head.encode() + b"A" * (200 << 20) + b'"}]}'
    started = time.monotonic()
    with pytest.raises(UnusableAssetError) as caught:
        read(text, {})

    assert time.monotonic() - started < SECONDS
    assert caught.value.code == "asset_too_large"
    assert len(caught.value.message) < 200
    # A shorter one that is still too long for data URIs is not decoded.
    shorter = head.encode() + b"A" * (130 << 20) + b'"}]}'
    assert "in data URIs" in refused(shorter).message


def test_gltf_3_nodes_100000_deep() -> None:
    nodes: list[dict[str, Any]] = [{"children": [i + 1]} for i in range(100_000)]
    error = refused(Builder(nodes=[*nodes, {}]).gltf())

    assert error.code == "asset_too_large"
    assert error.message == "/nodes: 100001 items; at most 10000 are taken"


def test_one_large_mesh_at_many_nodes_is_counted_at_each() -> None:
    builder = Builder()
    builder.mesh(TRIANGLE, np.zeros(30_000))
    builder.json["nodes"] = [{"mesh": 0}] * 420

    assert "4200000 triangles" in refused(builder.glb()).message


def test_many_primitives_at_many_nodes_are_too_many_draws() -> None:
    builder = Builder()
    builder.mesh()
    primitives = builder.json["meshes"][0]["primitives"]
    builder.json["meshes"][0]["primitives"] = primitives * 1000
    builder.json["nodes"] = [{"mesh": 0}] * 11

    assert "11000 draws" in refused(builder.glb()).message


def test_one_vertex_list_for_many_primitives_is_counted_by_what_they_use() -> None:
    builder = Builder()
    builder.mesh(np.zeros((100_000, 3)), [7, 8, 9], {})
    primitives = builder.json["meshes"][0]["primitives"]
    builder.json["meshes"][0]["primitives"] = primitives * 1000
    builder.json |= shown(0)
    started = time.monotonic()
    model = read(builder.glb(), {})

    assert time.monotonic() - started < SECONDS
    assert len(model.parts) == 1000
    assert len(model.parts[0].mesh.positions) == 3


def test_thousands_of_morph_targets_are_too_much_work() -> None:
    builder = Builder()
    builder.mesh(np.zeros((20_000, 3)))
    (primitive,) = builder.json["meshes"][0]["primitives"]
    primitive["targets"] = [primitive["attributes"]] * 4000
    builder.json["meshes"][0]["weights"] = [1] * 4000
    builder.json |= shown(0)

    assert "morph targets" in refused(builder.glb()).message


def test_poses_of_one_mesh_are_counted_each() -> None:
    builder = Builder()
    builder.mesh(np.zeros((100_000, 3)))
    (primitive,) = builder.json["meshes"][0]["primitives"]
    primitive["targets"] = [{}]
    builder.json["nodes"] = [{"mesh": 0, "weights": [n / 100]} for n in range(90)]

    assert "vertices; at most" in refused(builder.glb()).message


@pytest.mark.parametrize(
    "text",
    [
        b'{"asset":' * 70_000,
        b'{"\\' * 100_000,
        b'"\\"' * 100_000,
        b'{"a":"' + b"\\" * 1_000_001,
        b"{" + b'"a":0,' * 200_000 + b'"b":0}',
    ],
)
def test_odd_texts_take_no_time(text: bytes) -> None:
    assert refused(glb(text)).code in ("asset_unusable", "asset_too_large")


def test_long_texts_are_not_repeated() -> None:
    long = "secret" * 10_000
    for document in (
        {"asset": {"version": long}},
        {"asset": {"version": "2.0"}, "extensionsUsed": [long], "extensionsRequired": [long]},
        {"asset": {"version": "2.0"}, "meshes": [{"primitives": [{"attributes": {long: "x"}}]}]},
        {"asset": {"version": "2.0"}, "images": [{"uri": f"{long}:x"}]},
        {"asset": {"version": "2.0"}, "nodes": [{"camera": long}]},
    ):
        message = refused(json.dumps(document).encode()).message
        assert "secret" not in message
        assert len(message) < 200
