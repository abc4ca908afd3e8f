"""Damaged copies of good files: read or refused by name, whatever the damage."""

import json
import operator
import warnings
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.worker.models.gltf.building import Builder, data_uri, png
from worker.errors import WorkerError
from worker.models.gltf.reader import read

CODES = {"asset_unusable", "asset_unsupported", "asset_too_large", "asset_file_missing"}
OUTCOMES = {None, *CODES}
"""A model, or one of the refusals."""


def whole() -> Builder:
    """A little of everything."""
    name = "KHR_lights_punctual"
    builder = Builder(
        extensionsUsed=[name, "KHR_texture_transform", "KHR_materials_clearcoat"],
        extensions={name: {"lights": [{"type": "spot", "spot": {"outerConeAngle": 0.5}}]}},
        cameras=[{"type": "perspective", "perspective": {"yfov": 1, "znear": 0.1}}],
        scenes=[{"nodes": [0, 1]}],
        scene=0,
    )
    builder.add("images", {"bufferView": builder.view(png(alpha=True)), "mimeType": "image/png"})
    builder.add("images", {"uri": data_uri(png(), "image/png")})
    builder.add("samplers", {"wrapS": 33071, "minFilter": 9987})
    builder.json["textures"] = [{"source": 0, "sampler": 0}, {"source": 1}]
    moved = {"KHR_texture_transform": {"offset": [0.5, 0], "rotation": 1, "scale": [2, 2]}}
    builder.add(
        "materials",
        {
            "pbrMetallicRoughness": {"baseColorTexture": {"index": 0, "extensions": moved}},
            "normalTexture": {"index": 1, "scale": 0.5},
            "alphaMode": "MASK",
            "extensions": {"KHR_materials_clearcoat": {"clearcoatTexture": {"index": 1}}},
        },
    )
    builder.json["skins"] = [{"joints": [2]}]
    attributes = {
        "NORMAL": builder.accessor([[0, 0, 1]] * 4),
        "TANGENT": builder.accessor([[1, 0, 0, 1]] * 4),
        "TEXCOORD_0": builder.accessor([[0, 0], [1, 0], [1, 1], [0, 1]]),
        "COLOR_0": builder.accessor([[255, 0, 0, 255]] * 4, "<u1", normalized=True),
        "JOINTS_0": builder.accessor([[0, 0, 0, 0]] * 4, "<u1"),
        "WEIGHTS_0": builder.accessor([[1, 0, 0, 0]] * 4),
    }
    square = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [1, 1, 0]]
    target = builder.accessor([[0, 0, 1]] * 4)
    builder.mesh(
        square, [0, 1, 2, 3], attributes, material=0, mode=5, targets=[{"POSITION": target}]
    )
    builder.json["meshes"][0]["weights"] = [0.5]
    builder.json["nodes"] = [
        {"mesh": 0, "skin": 0, "children": [2]},
        {"mesh": 0, "camera": 0, "extensions": {name: {"light": 0}}, "scale": [1, -1, 1]},
        {"translation": [1, 2, 3], "rotation": [0, 0, 0, 1]},
    ]
    return builder


GLB = whole().glb()
DOCUMENT = json.loads(whole().gltf())


def told(data: bytes) -> str | None:
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        try:
            model = read(data, {})
        except WorkerError as error:
            refusal = error
        else:
            refusal = None
    if refusal is not None:
        assert refusal.code in CODES
        assert len(refusal.message) < 300
        return refusal.code
    for part in model.parts:
        mesh = part.mesh
        arrays = [mesh.positions, mesh.normals, *mesh.uv_sets, part.matrix]
        assert all(np.isfinite(array).all() for array in arrays)
        assert mesh.triangles.max() < len(mesh.positions)
    return None


def test_the_file_is_good_before_it_is_damaged() -> None:
    assert told(GLB) is None
    model = read(GLB, {})
    assert (len(model.parts), len(model.cameras), len(model.lights)) == (2, 1, 1)
    assert model.warnings == ()


@settings(max_examples=400)
@given(
    st.lists(st.tuples(st.integers(0, len(GLB) - 1), st.integers(0, 255)), min_size=1, max_size=4)
)
def test_changed_bytes_end_in_a_model_or_a_named_refusal(changes: list[tuple[int, int]]) -> None:
    damaged = bytearray(GLB)
    for place, byte in changes:
        damaged[place] = byte
    assert told(bytes(damaged)) in OUTCOMES


def altered(path: tuple[Any, ...], change: Callable[[Any, Any], None]) -> bytes:
    """The document, with a change to what holds the value at a path."""
    document = inner = json.loads(json.dumps(DOCUMENT))
    for key in path[:-1]:
        inner = inner[key]
    change(inner, path[-1])
    return json.dumps(document).encode()


def places(value: Any, path: tuple[Any, ...] = ()) -> list[tuple[Any, ...]]:
    children = (
        value.items()
        if isinstance(value, dict)
        else enumerate(value)
        if isinstance(value, list)
        else ()
    )
    return [path, *(p for key, child in children for p in places(child, (*path, key)))]


PLACES = [path for path in places(DOCUMENT) if path]
ODD: list[Any] = [
    None, True, -1, 0, 1, 3, 1.5, 1e30, 1e308, 2**31, 2**32, 2**64, "", "x", "../x", [], {}, [[]],
    [0], [1e9, 0, 0], {"index": 0}, {"extensions": {"KHR_texture_transform": {"scale": [0, 1e6]}}},
]  # fmt: skip


@pytest.mark.parametrize("odd", ODD, ids=repr)
def test_a_value_changed_for_an_odd_one_ends_in_a_model_or_a_named_refusal(odd: Any) -> None:
    def put(inner: Any, key: Any) -> None:
        inner[key] = odd

    outcomes = [told(altered(path, put)) for path in PLACES]

    assert set(outcomes) <= OUTCOMES
    assert any(outcomes)


def test_a_value_left_out_ends_in_a_model_or_a_named_refusal() -> None:
    outcomes = [told(altered(path, operator.delitem)) for path in PLACES]

    assert set(outcomes) <= OUTCOMES
    assert None in outcomes
    assert any(outcomes)
