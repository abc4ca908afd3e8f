"""Skinned meshes at rest: vertices are carried by the joints they hang on."""

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from worker.models.gltf.accessors import Accessors, Rows
from worker.models.gltf.document.meshes import Primitive, Skin
from worker.models.gltf.faults import unusable
from worker.models.gltf.semantics import sets_of
from worker.models.gltf.vertices import Floats, Vertices

_CHUNK = 1 << 16
_ROW_TOLERANCE = 1e-4


def joint_matrices(
    skin: Skin, model_from_node: NDArray[np.float64], accessors: Accessors, place: str
) -> Floats:
    """Return model_from_mesh as each joint has it: (joints, 3, 4).

    The place of the node that carries the mesh does not matter, as glTF 2.0, section 3.7.3.3, says.

    Raises:
        UnusableAssetError: An inverse bind matrix is not affine or not finite.
    """
    model_from_joint = model_from_node[skin.joints]
    if skin.inverse_bind_matrices is None:
        return model_from_joint[:, :3]
    numbers = accessors.numbers(skin.inverse_bind_matrices, np.arange(len(skin.joints)))
    joint_from_mesh = numbers.reshape(-1, 4, 4).transpose(0, 2, 1)
    if np.abs(joint_from_mesh[:, 3] - (0, 0, 0, 1)).max() > _ROW_TOLERANCE:
        raise unusable(f"{place}/inverseBindMatrices", "a last row is not 0 0 0 1")
    return np.asarray((model_from_joint @ joint_from_mesh)[:, :3])


def bent(
    vertices: Vertices,
    primitive: Primitive,
    joints: Floats,
    accessors: Accessors,
    rows: Rows | None,
    place: str,
) -> tuple[Vertices, NDArray[np.bool_]]:
    """Move vertices with their joints, linearly blended.

    Weights are brought to a sum of one; a vertex without any hangs on its first joint.

    Returns:
        The vertices in the model's frame, and which of them were turned inside out.

    Raises:
        UnusableAssetError: A vertex hangs on a joint that the skin does not have.
    """
    sets = sets_of(list(primitive.attributes), "JOINTS")
    bones = np.concatenate(
        [accessors.raw(primitive.attributes[f"JOINTS_{n}"], rows) for n in sets], axis=1
    ).astype(np.int64)
    weights = np.concatenate(
        [accessors.numbers(primitive.attributes[f"WEIGHTS_{n}"], rows) for n in sets], axis=1
    )
    np.maximum(weights, 0, out=weights)
    if (bones[weights > 0] >= len(joints)).any():
        raise unusable(f"{place}/attributes", f"a joint is not below {len(joints)}")
    bones[weights == 0] = np.minimum(bones, len(joints) - 1)[weights == 0]
    total = weights.sum(axis=1)
    weights[total == 0, 0] = 1.0
    weights /= np.where(total == 0, 1.0, total)[:, None]

    positions = np.empty_like(vertices.positions)
    normals = None if vertices.normals is None else np.empty_like(vertices.normals)
    tangents = None if vertices.tangents is None else vertices.tangents.copy()
    mirrored = np.empty(len(positions), bool)
    for start in range(0, len(positions), _CHUNK):
        piece = slice(start, start + _CHUNK)
        matrix = np.einsum("nk,nkij->nij", weights[piece], joints[bones[piece]])
        turn = matrix[:, :, :3]
        positions[piece] = _times(turn, vertices.positions[piece]) + matrix[:, :, 3]
        cofactors = np.cross(turn[:, [1, 2, 0]], turn[:, [2, 0, 1]])
        determinant = np.einsum("nj,nj->n", turn[:, 0], cofactors[:, 0])
        mirrored[piece] = determinant < 0
        sign = np.where(mirrored[piece], -1.0, 1.0)
        if normals is not None and vertices.normals is not None:
            normals[piece] = _times(cofactors, vertices.normals[piece]) * sign[:, None]
        if tangents is not None:
            tangents[piece, :3] = _times(turn, tangents[piece, :3])
            tangents[piece, 3] *= sign
    return replace(vertices, positions=positions, normals=normals, tangents=tangents), mirrored


def _times(matrices: Floats, vectors: Floats) -> Floats:
    return np.asarray(np.einsum("nij,nj->ni", matrices, vectors))
