"""From a primitive of glTF to the worker's mesh.

glTF's texture coordinates run down (v = 0 is the upper edge of the picture), the worker's run up;
v becomes 1 - v here and nowhere else. Tangents stay as they are, with the sign of their bitangent:
glTF's bitangent w cross(n, t) is where the *green* of a normal map points, which is the picture's
up. A picture that lies unmirrored on z = 0 and is seen from +z has t = +x and n = +z, so that
w = +1 gives the bitangent +y, its upper edge: against glTF's v, along ours. For us w is the sign of
det(P_u, P_v, n), for glTF with its own v the opposite of that.
"""

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from worker.geometry.mesh import Mesh
from worker.models.gltf.accessors import Accessors, Rows
from worker.models.gltf.document.meshes import Primitive
from worker.models.gltf.document.root import Document
from worker.models.gltf.faults import unusable
from worker.models.gltf.skinning import bent
from worker.models.gltf.topology import KINDS, assemble
from worker.models.gltf.vertices import Floats, Vertices, morphed

_SPARSELY_USED = 4
_ANY_DIRECTION = (0.0, 0.0, 1.0)


@dataclass(frozen=True, slots=True)
class Pose:
    """How a mesh is deformed where it stands.

    Attributes:
        weights: Of its morph targets.
        joints: model_from_mesh of each joint of its skin, (joints, 3, 4), if it has one.
    """

    weights: tuple[float, ...]
    joints: Floats | None = None


def shape(
    document: Document,
    accessors: Accessors,
    primitive: Primitive,
    pose: Pose,
    place: str,
    warnings: list[str],
) -> Mesh | None:
    """Read, deform and complete a primitive.

    Args:
        document: With meshes that have been checked.
        accessors: Its numbers.
        primitive: What is read.
        pose: Its deformation.
        place: Of the primitive in the document.
        warnings: Gets what was repaired.

    Returns:
        The mesh, in the model's frame if it is skinned; None where nothing is to be drawn.

    Raises:
        UnusableAssetError: An index is out of range, a number is not finite.
    """
    if "POSITION" not in primitive.attributes:
        warnings.append("a primitive without positions is not drawn")
        return None
    elements, rows = _elements(document, accessors, primitive, place)
    if not len(elements):
        warnings.append("a primitive with too few vertices is not drawn")
        return None
    vertices = Vertices.read(primitive, accessors, rows)
    if any(pose.weights):
        vertices = morphed(vertices, primitive, list(pose.weights), accessors, rows)
    if pose.joints is not None:
        vertices, mirrored = bent(vertices, primitive, pose.joints, accessors, rows, place)
        if elements.shape[1] == 3:
            inside_out = mirrored[elements[:, 0]]
            elements[inside_out] = elements[inside_out, ::-1]
    if vertices.normals is None and KINDS[primitive.mode] == "triangles":
        vertices, normals, elements = _faceted(vertices, elements)
    else:
        normals = _smooth(vertices, elements)
    return _finished(vertices, normals, elements, primitive.mode, warnings)


def _elements(
    document: Document, accessors: Accessors, primitive: Primitive, place: str
) -> tuple[NDArray[np.int64], Rows | None]:
    """Return what is drawn in terms of the rows that are read, and those rows if not all are."""
    count = document.accessors[primitive.attributes["POSITION"]].count
    if primitive.indices is None:
        return assemble(primitive.mode, np.arange(count)), None
    stored = accessors.raw(primitive.indices)[:, 0]
    indices = stored.astype(np.int64)
    highest = int(indices.max())
    if highest == np.iinfo(stored.dtype).max:
        raise unusable(f"{place}/indices", f"index {highest} would restart the primitive")
    if highest >= count:
        position = int(np.argmax(indices))
        raise unusable(f"{place}/indices", f"index {position} is {highest}, not below {count}")
    # Exporters let many primitives share one long list of vertices: only those in use are read.
    if _SPARSELY_USED * len(indices) < count:
        rows, indices = np.unique(indices, return_inverse=True)
        return assemble(primitive.mode, indices), rows
    used = np.zeros(count, bool)
    used[indices] = True
    if used.all():
        return assemble(primitive.mode, indices), None
    return assemble(primitive.mode, (np.cumsum(used) - 1)[indices]), np.flatnonzero(used)


def _faceted(
    vertices: Vertices, triangles: NDArray[np.int64]
) -> tuple[Vertices, Floats, NDArray[np.int64]]:
    """Give each triangle corners of its own and its own normal; tangents without normals go."""
    split = replace(vertices, tangents=None).taken(triangles.ravel())
    normals, length = _unit(_areas(split.positions.reshape(-1, 3, 3)))
    normals[length == 0] = _ANY_DIRECTION
    corners = np.arange(3 * len(triangles)).reshape(-1, 3)
    return split, np.repeat(normals, 3, axis=0), corners


def _smooth(vertices: Vertices, elements: NDArray[np.int64]) -> Floats:
    """Bring normals to length one; where a triangle has none, take the mean of its neighbours."""
    if vertices.normals is None:
        return np.zeros_like(vertices.positions)
    normals, length = _unit(vertices.normals)
    if elements.shape[1] < 3 or length.all():
        return normals
    areas = _areas(vertices.positions[elements])
    sums = np.zeros_like(normals)
    for corner in range(3):
        np.add.at(sums, elements[:, corner], areas)
    means, found = _unit(sums)
    means[found == 0] = _ANY_DIRECTION
    return np.where(length[:, None] > 0, normals, means)


def _finished(
    vertices: Vertices,
    normals: Floats,
    elements: NDArray[np.int64],
    mode: int,
    warnings: list[str],
) -> Mesh:
    colors = vertices.colors
    if colors is not None and (colors.min() < 0 or colors.max() > 1):
        warnings.append("vertex colours outside of 0..1 are cut")
        colors = np.clip(colors, 0, 1)
    return Mesh(
        positions=vertices.positions,
        normals=normals,
        uv_sets=tuple(np.column_stack([uv[:, 0], 1 - uv[:, 1]]) for uv in vertices.uv_sets),
        triangles=elements.astype(np.uint32),
        tangents=_tangents(vertices, warnings),
        colors=colors,
        kind=KINDS[mode],
    )


def _tangents(vertices: Vertices, warnings: list[str]) -> Floats | None:
    if vertices.tangents is None or vertices.normals is None:
        return None
    along, length = _unit(vertices.tangents[:, :3])
    sign = np.sign(vertices.tangents[:, 3])
    if not (length.all() and sign.all()):
        warnings.append("tangents without a direction or a sign are made anew")
        return None
    return np.column_stack([along, sign])


def _unit(vectors: Floats) -> tuple[Floats, Floats]:
    """Return the vectors at length one, or zero, and the latter where they have none."""
    x, y, z = np.abs(vectors).T
    largest = np.maximum(np.maximum(x, y), z)
    scaled = vectors / np.where(largest > 0, largest, 1.0)[:, None]
    length = np.sqrt(np.einsum("ij,ij->i", scaled, scaled))
    return scaled / np.where(length > 0, length, 1.0)[:, None], length


def _areas(corners: Floats) -> Floats:
    """Return the normals of triangles (n, 3, 3), twice as long as their areas are large."""
    a, b = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    return np.stack(
        [
            a[:, 1] * b[:, 2] - a[:, 2] * b[:, 1],
            a[:, 2] * b[:, 0] - a[:, 0] * b[:, 2],
            a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0],
        ],
        axis=1,
    )
