"""What of a mesh is refused before its numbers are read, after glTF 2.0, section 3.7.2."""

from typing import Any

import pytest

from tests.worker.models.gltf.building import TRIANGLE, Builder
from worker.errors import UnusableAssetError
from worker.models.gltf.reader import check


def refused(builder: Builder) -> UnusableAssetError:
    with pytest.raises(UnusableAssetError) as caught:
        check(builder.glb())
    return caught.value


def with_attributes(builder: Builder, attributes: dict[str, int], **primitive: Any) -> Builder:
    builder.mesh(TRIANGLE, [0, 1, 2], attributes, **primitive)
    return builder


def joint_sets(builder: Builder, count: int) -> dict[str, int]:
    joints = builder.accessor([[0, 0, 0, 0]] * 3, "<u1")
    weights = builder.accessor([[1, 0, 0, 0]] * 3)
    return {
        **{f"JOINTS_{n}": joints for n in range(count)},
        **{f"WEIGHTS_{n}": weights for n in range(count)},
    }


def test_joints_and_weights_come_in_pairs() -> None:
    for name in ("JOINTS_0", "WEIGHTS_0"):
        builder = Builder()
        attributes = joint_sets(builder, 1)
        del attributes[name]

        assert (
            "as many sets of JOINTS as of WEIGHTS"
            in refused(with_attributes(builder, attributes)).message
        )


def test_more_than_sixteen_joints_of_a_vertex_are_unsupported() -> None:
    builder = Builder()
    check(with_attributes(builder, joint_sets(builder, 4)).glb())
    builder = Builder()

    assert refused(with_attributes(builder, joint_sets(builder, 5))).code == "asset_unsupported"


@pytest.mark.parametrize(
    ("target", "word"),
    [
        ({"NORMAL": 0}, "there is no NORMAL to be moved"),
        ({"JOINTS_0": 0}, "no target can move JOINTS_0"),
        ({"SPEED": 0}, "no target can move SPEED"),
        ({"POSITION": 1}, "another number of elements"),
        ({"POSITION": 2}, "format"),
        ({"POSITION": 9}, "index 9 is not below"),
    ],
)
def test_a_target_moves_what_is_there(target: dict[str, int], word: str) -> None:
    builder = Builder()
    builder.accessor(TRIANGLE)
    builder.accessor([[0, 0, 0]] * 2)
    builder.accessor([[0, 0]] * 3)

    error = refused(with_attributes(builder, {}, targets=[{"_CUSTOM": 0}, target]))
    assert word in error.message
    assert error.message.startswith("/meshes/0/primitives/0/targets/1")


def test_primitives_of_a_mesh_have_equally_many_targets_and_a_weight_for_each() -> None:
    builder = with_attributes(Builder(), {}, targets=[{"POSITION": 0}])
    builder.json["meshes"][0]["weights"] = [1, 2]
    assert "as many weights as morph targets" in refused(builder).message

    del builder.json["meshes"][0]["weights"]
    (primitive,) = builder.json["meshes"][0]["primitives"]
    without = {key: value for key, value in primitive.items() if key != "targets"}
    builder.json["meshes"][0]["primitives"] = [primitive, without]
    assert "different numbers of morph targets" in refused(builder).message


@pytest.mark.parametrize("mode", [-1, 7, 100, 1.5, "4"])
def test_a_mode_is_one_of_seven(mode: Any) -> None:
    error = refused(with_attributes(Builder(), {}, mode=mode))

    assert error.message.startswith("/meshes/0/primitives/0/mode: ")


def test_indices_are_packed_unsigned_integers() -> None:
    builder = with_attributes(Builder(), {})
    builder.json["bufferViews"][1]["byteStride"] = 4
    builder.json["accessors"][1]["count"] = 1
    assert "byteStride" in refused(builder).message

    for dtype in ("<i2", "<f4"):
        builder = Builder()
        index = builder.accessor([0, 1, 2], dtype)
        builder.mesh()
        builder.json["meshes"][0]["primitives"][0]["indices"] = index
        assert "/indices: accessor 0 has a format" in refused(builder).message


def test_a_texture_can_use_the_first_four_sets_only() -> None:
    for uv_set, code in ((3, None), (4, "asset_unsupported"), (5, "asset_unusable")):
        builder = Builder(textures=[{}])
        sets = {f"TEXCOORD_{n}": builder.accessor([[0, 0]] * 3) for n in range(5)}
        builder.add("materials", {"emissiveTexture": {"index": 0, "texCoord": uv_set}})
        with_attributes(builder, sets, material=0)

        if code is None:
            check(builder.glb())
        else:
            assert refused(builder).code == code


def test_attributes_of_applications_may_be_anything() -> None:
    builder = Builder()
    custom = builder.accessor([0, 1, 2], "<u4")

    checked = check(with_attributes(builder, {"_BATCH_ID": custom}).glb())

    [mesh] = checked.document.meshes
    assert mesh.primitives[0].attributes["_BATCH_ID"] == custom
    assert checked.warnings == ()
