"""Trees of nodes: where things stand, and what is no tree."""

import math
from typing import Any

import numpy as np
import pytest

from tests.worker.models.gltf.building import Builder
from worker.errors import RenderError, UnusableAssetError
from worker.models.gltf.limits import ITEMS_MAX
from worker.models.gltf.reader import read

HALF = math.sqrt(0.5)


def scene_of(nodes: list[dict[str, Any]], **members: Any) -> Builder:
    builder = Builder(nodes=nodes, **members)
    builder.mesh()
    return builder


def refused(builder: Builder) -> str:
    with pytest.raises(UnusableAssetError) as caught:
        read(builder.glb(), {})
    return caught.value.message


def test_a_child_is_scaled_then_turned_then_moved_and_then_by_its_parent() -> None:
    child = {
        "mesh": 0,
        "scale": [2, 3, 4],
        "rotation": [0, 0, HALF, HALF],
        "translation": [0, 0, 5],
    }
    builder = scene_of([{"children": [1], "translation": [10, 0, 0], "scale": [1, -1, 1]}, child])
    (part,) = read(builder.glb(), {}).parts

    # (x, y, z) -> (-3y, 2x, 4z + 5) -> (10 - 3y, -2x, 4z + 5)
    assert part.matrix == pytest.approx(
        np.array([[0, -3, 0, 10], [-2, 0, 0, 0], [0, 0, 4, 5], [0, 0, 0, 1]]), abs=1e-15
    )
    assert part.node == 1


def test_a_matrix_is_read_column_by_column() -> None:
    matrix = [0, 2, 0, 0, -2, 0, 0, 0, 0, 0, 2, 0, 7, 8, 9, 1]
    (part,) = read(scene_of([{"mesh": 0, "matrix": matrix}]).glb(), {}).parts

    assert part.matrix.tolist() == [[0, -2, 0, 7], [2, 0, 0, 8], [0, 0, 2, 9], [0, 0, 0, 1]]


def test_the_scene_is_the_one_asked_for_else_the_files_own_else_its_first() -> None:
    nodes = [{"mesh": 0, "name": name} for name in ("a", "b", "c")]
    scenes = [{"nodes": [0]}, {"nodes": [1]}, {}]
    builder = scene_of(nodes, scenes=scenes, scene=1)

    def seen(scene: int | None = None) -> list[str]:
        model = read(builder.glb(), {}, scene)
        return [model.node_names[part.node or 0] for part in model.parts]

    assert seen() == ["b"]
    assert seen(0) == ["a"]
    assert seen(2) == []
    del builder.json["scene"]
    assert seen() == ["a"]
    del builder.json["scenes"]
    assert seen() == ["a", "b", "c"]
    with pytest.raises(RenderError, match="0 scenes and no scene 0") as caught:
        seen(0)
    assert caught.value.code == "model_part_unknown"


@pytest.mark.parametrize(
    ("nodes", "message"),
    [
        ([{"children": [0]}], "/nodes/0: the node is below itself"),
        ([{"children": [1]}, {"children": [2]}, {"children": [1]}], "node 1 has two parents"),
        ([{"children": [1]}, {"children": [0]}], "/nodes/0: the node is below itself"),
        ([{"children": [2]}, {"children": [2]}, {}], "/nodes/1/children/0: node 2 has two parents"),
        ([{"children": [1, 1]}, {}], "two elements are equal"),
        ([{"children": [1]}], "/nodes/0/children/0: index 1 is not below 1"),
        ([{"children": [-1]}], "/nodes/0/children/0: "),
        ([{"mesh": 1}], "/nodes/0/mesh: index 1 is not below 1"),
        ([{"rotation": [0, 0, 0, 0]}], "unit length"),
        ([{"rotation": [0, 0, 0.9, 0.9]}], "unit length"),
        ([{"scale": [1, 1]}], "at least 3 items"),
        ([{"translation": [0, 0, "1"]}], "valid number"),
        ([{"translation": [0, 0, 1e39]}], "less than or equal to"),
        ([{"matrix": [1.0] * 15 + [2]}], "last row"),
        ([{"matrix": [1, 0, 0, 0, 1, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]}], "not made of"),
        (
            [{"matrix": np.eye(4).ravel().tolist(), "scale": [1, 1, 1]}],
            "beside",
        ),
        ([{"translation": [2e9, 0, 0]}], "/nodes/0: its matrix has numbers beyond 1e+09"),
        ([{"mesh": 0, "translation": [1e9, 0, 0]}], "/nodes/0: its mesh reaches beyond 1e+09"),
    ],
)
def test_what_is_no_tree_or_no_place_is_refused(nodes: list[dict[str, Any]], message: str) -> None:
    assert message in refused(scene_of(nodes))


def test_a_scene_shows_only_roots() -> None:
    builder = scene_of([{"children": [1]}, {}], scenes=[{"nodes": [1]}])

    assert refused(builder) == "/scenes/0/nodes/0: node 1 is not a root"


def test_the_deepest_tree_that_is_taken_is_composed_to_its_end() -> None:
    nodes: list[dict[str, Any]] = [
        {"children": [i + 1], "translation": [1, 0, 0]} for i in range(ITEMS_MAX - 1)
    ]
    (part,) = read(scene_of([*nodes, {"mesh": 0}]).glb(), {}).parts

    assert part.matrix[:3, 3].tolist() == [ITEMS_MAX - 1, 0, 0]


def test_a_later_version_is_told() -> None:
    builder = Builder(asset={"version": "2.1", "minVersion": "2.0"})

    assert read(builder.gltf(), {}).warnings == ("it is made for a later glTF than 2.0",)
