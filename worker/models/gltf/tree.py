"""The trees of nodes: that they are trees, and where each node stands."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from worker.errors import RenderError
from worker.models.gltf.document.root import Document
from worker.models.gltf.document.scene import Node
from worker.models.gltf.faults import unusable
from worker.models.gltf.semantics import sets_of
from worker.models.limits import FARTHEST

_SHEAR_TOLERANCE = 1e-3
_ROW_TOLERANCE = 1e-5


@dataclass(frozen=True, slots=True)
class Tree:
    """Where all nodes stand.

    Attributes:
        parents: By node; -1 for a root.
        model_from_node: float64 (nodes, 4, 4).
    """

    parents: tuple[int, ...]
    model_from_node: NDArray[np.float64]


def check_nodes(document: Document) -> None:
    """Check what each node says of itself and of its mesh and skin.

    Raises:
        UnusableAssetError: `asset_unusable`.
    """
    for index, node in enumerate(document.nodes):
        place = f"/nodes/{index}"
        if node.matrix is not None:
            _check_matrix(node.matrix, f"{place}/matrix")
        if node.mesh is not None:
            _check_mesh(document, node, node.mesh, place)


def grow(document: Document) -> Tree:
    """Find each node's parent and compose the matrices, from the roots on, in float64.

    Raises:
        UnusableAssetError: A node has two parents, is its own ancestor, is shown by a scene and
            hangs below another, or stands beyond all measure.
    """
    parents = _parents(document)
    matrices = np.empty((len(parents), 4, 4))
    reached = [index for index, parent in enumerate(parents) if parent < 0]
    for index in reached:
        local = local_matrix(document.nodes[index])
        parent = parents[index]
        matrices[index] = local if parent < 0 else matrices[parent] @ local
        if not (np.abs(matrices[index]) <= FARTHEST).all():
            raise unusable(f"/nodes/{index}", f"its matrix has numbers beyond {FARTHEST:g}")
        reached += document.nodes[index].children or ()
    if len(reached) < len(parents):
        lost = min(set(range(len(parents))) - set(reached))
        raise unusable(f"/nodes/{lost}", "the node is below itself")
    return Tree(tuple(parents), matrices)


def shown_nodes(document: Document, tree: Tree, scene: int | None) -> list[int]:
    """Return the nodes of a scene, parents before children.

    Args:
        document: The document.
        tree: Its nodes.
        scene: Which scene; the document's own without, else its first, else all there is.

    Raises:
        RenderError: There is no such scene (`model_part_unknown`).
    """
    if scene is not None and scene >= len(document.scenes):
        raise RenderError(
            f"the model has {len(document.scenes)} scenes and no scene {scene}",
            code="model_part_unknown",
        )
    if scene is None:
        scene = document.scene if document.scene is not None else 0
    if scene < len(document.scenes):
        shown = list(document.scenes[scene].nodes or ())
    else:
        shown = [index for index, parent in enumerate(tree.parents) if parent < 0]
    for index in shown:
        shown += document.nodes[index].children or ()
    return shown


def local_matrix(node: Node) -> NDArray[np.float64]:
    """Compose translation, rotation and scale, or take the matrix: parent_from_node."""
    if node.matrix is not None:
        return np.array(node.matrix).reshape(4, 4).T
    matrix = np.eye(4)
    if node.rotation is not None:
        x, y, z, w = np.array(node.rotation) / np.linalg.norm(node.rotation)
        matrix[:3, :3] = [
            [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
            [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
            [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
        ]
    if node.scale is not None:
        matrix[:3, :3] *= node.scale
    if node.translation is not None:
        matrix[:3, 3] = node.translation
    return matrix


def _parents(document: Document) -> list[int]:
    parents = [-1] * len(document.nodes)
    for index, node in enumerate(document.nodes):
        for k, child in enumerate(node.children or ()):
            if parents[child] >= 0:
                raise unusable(f"/nodes/{index}/children/{k}", f"node {child} has two parents")
            parents[child] = index
    for i, scene in enumerate(document.scenes):
        for k, root in enumerate(scene.nodes or ()):
            if parents[root] >= 0:
                raise unusable(f"/scenes/{i}/nodes/{k}", f"node {root} is not a root")
    return parents


def _check_matrix(numbers: list[float], place: str) -> None:
    matrix = np.array(numbers).reshape(4, 4).T
    if np.abs(matrix[3] - (0, 0, 0, 1)).max() > _ROW_TOLERANCE:
        raise unusable(place, "its last row is not 0 0 0 1")
    lengths = np.linalg.norm(matrix[:3, :3], axis=0)
    axes = matrix[:3, :3] / np.where(lengths > 0, lengths, 1)
    if np.abs(axes.T @ axes - np.diag(lengths > 0)).max() > _SHEAR_TOLERANCE:
        raise unusable(place, "it is not made of translation, rotation and scale")


def _check_mesh(document: Document, node: Node, mesh: int, place: str) -> None:
    primitives = document.meshes[mesh].primitives
    if node.skin is not None and not all(
        sets_of(list(primitive.attributes), "JOINTS") for primitive in primitives
    ):
        raise unusable(f"{place}/skin", "the mesh has no JOINTS")
    if node.weights is not None and len(node.weights) != len(primitives[0].targets or ()):
        raise unusable(f"{place}/weights", "there are not as many weights as morph targets")
