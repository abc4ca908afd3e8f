"""What a file tells of itself, with and without the files beside it."""

from dataclasses import replace

import numpy as np
import pytest

from tests.worker.models.gltf.building import Builder, data_uri, png
from worker.errors import UnusableAssetError
from worker.models.gltf.outline import outline
from worker.models.outline import Outline

NOTHING = Outline(
    triangles=0,
    lines=0,
    points=0,
    vertices=0,
    draws=0,
    bounds=None,
    uv_sets=0,
    has_normals=False,
    has_tangents=False,
    has_vertex_colours=False,
)


def some() -> Builder:
    builder = Builder(
        cameras=[{"type": "perspective", "perspective": {"yfov": 1, "znear": 1}, "name": "eye"}],
        materials=[{"name": "red"}],
        nodes=[{"mesh": 0, "translation": [5, 0, 0]}, {"mesh": 1, "camera": 0, "name": "b"}],
    )
    attributes = {
        "NORMAL": builder.accessor([[0, 0, 1]] * 4),
        "TEXCOORD_0": builder.accessor([[0, 0]] * 4),
        "COLOR_0": builder.accessor([[1, 1, 1]] * 4),
    }
    square = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [1, 1, 0]]
    builder.mesh(square, attributes=attributes, mode=5, material=0)
    builder.mesh([[0, 0, 0], [1, 0, 0], [0, -2, 3]])
    for accessor in (builder.json["accessors"][3], builder.json["accessors"][4]):
        accessor |= {"min": [0, 0, 0], "max": [1, 1, 0]}
    builder.json["accessors"][4] |= {"min": [0, -2, 0], "max": [1, 0, 3]}
    builder.add("images", {"uri": data_uri(png(), "image/png")})
    return builder


EXPECTED = replace(
    NOTHING,
    triangles=3,
    vertices=7,
    draws=2,
    bounds=((0, -2, 0), (6, 1, 3)),
    uv_sets=1,
    has_normals=True,
    has_vertex_colours=True,
    materials=("red", ""),
    nodes=("", "b"),
    cameras=("eye",),
    pictures=(png(),),
)


def test_a_whole_file_is_measured_by_its_content() -> None:
    assert outline(some().glb()) == EXPECTED
    assert outline(some().gltf()) == EXPECTED


def test_a_file_with_others_beside_it_is_measured_by_its_json() -> None:
    text, _ = some().separate("shape.bin")

    assert outline(text) == replace(EXPECTED, files=("shape.bin",))


def test_what_lies_inside_is_checked_though_something_lies_beside() -> None:
    builder = some()
    builder.add("images", {"uri": data_uri(b"\x89PNG\r\n\x1a\n", "image/png")})

    with pytest.raises(UnusableAssetError, match=r"^/images/1"):
        outline(builder.separate()[0])
    with pytest.raises(UnusableAssetError, match=r"^/buffers/0/uri"):
        outline(some().separate("../shape.bin")[0])


def test_numbers_are_looked_at_where_the_file_has_them() -> None:
    builder = some()
    builder.binary[-4:] = np.array([np.nan], "<f4").tobytes()

    with pytest.raises(UnusableAssetError, match="not finite"):
        outline(builder.glb())


def test_a_scene_of_nothing_is_nothing() -> None:
    assert outline(Builder().gltf()) == NOTHING


def test_long_names_are_cut() -> None:
    assert outline(Builder(nodes=[{"name": "x" * 1000}]).gltf()).nodes == ("x" * 256,)
