"""Skins at rest: vertices go where their joints carry them."""

import math
from typing import Any

import numpy as np
import pytest

from tests.worker.models.gltf.building import Builder
from worker.errors import UnusableAssetError
from worker.models.gltf.reader import read
from worker.models.model import Part


def only_part(builder: Builder) -> Part:
    (part,) = read(builder.glb(), {}).parts
    return part


def arm() -> Builder:
    """A triangle at y = 1, whose skin hangs on an upright bone turned by 90 degrees about z."""
    builder = Builder()
    half = math.sqrt(0.5)
    back = np.eye(4, dtype="<f4")
    back[1, 3] = -1  # the bone's own frame has its origin at y = 1
    bind = builder.accessor(np.stack([np.eye(4), back]).transpose(0, 2, 1))
    builder.add("skins", {"joints": [1, 2], "inverseBindMatrices": bind})
    attributes = {
        "NORMAL": builder.accessor([[1, 0, 0]] * 3),
        "TANGENT": builder.accessor([[0, 1, 0, 1]] * 3),
        "JOINTS_0": builder.accessor([[0, 1, 0, 0]] * 3, "<u1"),
        "WEIGHTS_0": builder.accessor([[0, 1, 0, 0], [2, 0, 0, 0], [0, 0, 0, 0]]),
    }
    builder.mesh([[0, 3, 0], [0, 3, 0], [1, 1, 0]], attributes=attributes)
    builder.json["nodes"] = [
        {"mesh": 0, "skin": 0, "translation": [100, 0, 0]},
        {"children": [2]},
        {"translation": [0, 1, 0], "rotation": [0, 0, half, half]},
    ]
    return builder


def test_a_skin_at_rest_follows_its_joints_and_not_its_node() -> None:
    part = only_part(arm())

    # Two above the bone's origin turns to two on its left; the others hang on the root.
    assert part.mesh.positions == pytest.approx(
        np.array([[-2, 1, 0], [0, 3, 0], [1, 1, 0]]), abs=1e-6
    )
    assert part.mesh.normals == pytest.approx(np.array([[0, 1, 0], [1, 0, 0], [1, 0, 0]]), abs=1e-6)
    assert part.mesh.tangents == pytest.approx(
        np.array([[-1, 0, 0, 1], [0, 1, 0, 1], [0, 1, 0, 1]]), abs=1e-6
    )
    assert np.array_equal(part.matrix, np.eye(4))


def test_a_skin_that_mirrors_turns_its_triangles_round() -> None:
    builder = arm()
    builder.json["nodes"][1]["scale"] = [-1, 1, 1]
    mesh = only_part(builder).mesh

    assert mesh.positions[1:] == pytest.approx(np.array([[0, 3, 0], [-1, 1, 0]]), abs=1e-6)
    assert mesh.normals[1] == pytest.approx([-1, 0, 0])
    assert mesh.triangles.tolist() == [[2, 1, 0]]
    # The bitangent cross(x, y) = z does not turn, while the normal does: the sign has to.
    assert mesh.tangents is not None
    assert mesh.tangents[1].tolist() == [0, 1, 0, -1]


@pytest.mark.parametrize(
    ("change", "word"),
    [
        (lambda b: b.json["skins"][0].update(joints=[1]), "fewer|not below 1"),
        (lambda b: b.json["skins"][0].update(joints=[1, 1]), "equal"),
        (lambda b: b.json["skins"][0].update(joints=[1, 9]), "not below 3"),
        (lambda b: b.json["skins"][0].update(joints=[1, 2, 0]), "fewer matrices"),
        (lambda b: b.json["nodes"][0].update(skin=1), "not below 1"),
        (lambda b: b.json["nodes"][0].pop("mesh"), "need a mesh"),
    ],
)
def test_a_skin_that_cannot_be_is_refused(change: Any, word: str) -> None:
    builder = arm()
    change(builder)

    with pytest.raises(UnusableAssetError, match=word):
        read(builder.glb(), {})
