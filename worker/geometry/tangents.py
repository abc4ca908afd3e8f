"""Where u grows at every vertex, as normal maps are baked for: MikkTSpace.

Corners whose position, normal and uv are equal are one vertex. Round a vertex, triangles that share
an edge and whose charts are both mirrored, or both not, form a group. A group's tangent is the mean
of its triangles' tangents, laid into the plane of the normal and weighted by their angles at the
vertex. Where groups meet, the vertex is split.

Source: Mikkelsen, Simulation of wrinkled surfaces revisited, 2008, with the default threshold of
180 degrees; the tangents of a triangle: Hughes et al., 2013, section 20.7.
"""

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from worker.geometry.mesh import Mesh
from worker.geometry.topology import Floats, Indices, following, shared_edges, sums, weld

Flags = NDArray[np.bool_]
_NO_AREA = float(np.finfo(np.float32).tiny)


def with_tangents(mesh: Mesh, uv_set: int = 0) -> Mesh:
    """Return the mesh with tangents; one that has them, or no triangles, as it is.

    Args:
        mesh: Its vertices may be split, and those no triangle uses are dropped.
        uv_set: Which texture coordinates; where they give no direction, any across the normal is
            taken.
    """
    if mesh.tangents is not None or mesh.kind != "triangles" or not mesh.triangles.size:
        return mesh
    corners = mesh.triangles.astype(np.int64)
    charts = _Charts.of(mesh.positions, mesh.uv(uv_set), corners)
    welded = weld(np.hstack([mesh.positions, mesh.normals, mesh.uv(uv_set)]))[corners]
    groups, mirrored = _groups(mesh.positions[corners], welded, charts)
    totals = _sums(mesh, corners, charts, groups)
    vertex_and_group = corners.ravel() * (groups.max() + 1) + groups
    kept, chosen, triangles = np.unique(vertex_and_group, return_index=True, return_inverse=True)
    vertices = kept // (groups.max() + 1)
    tangents = np.empty((len(kept), 4))
    tangents[:, :3] = or_perpendicular(totals[groups[chosen]], mesh.normals[vertices])
    tangents[:, 3] = np.where(mirrored.ravel()[chosen], -1.0, 1.0)
    return replace(
        mesh,
        positions=mesh.positions[vertices],
        normals=mesh.normals[vertices],
        uv_sets=tuple(uv[vertices] for uv in mesh.uv_sets),
        triangles=triangles.reshape(corners.shape).astype(np.uint32),
        tangents=tangents,
        colors=None if mesh.colors is None else mesh.colors[vertices],
    )


def triangle_tangents(
    positions: Floats, uv: Floats, triangles: NDArray[np.integer]
) -> tuple[Floats, Floats, Floats]:
    """Give each triangle's derivatives of position by u and by v, times its determinant.

    f1 = dv2 w1 - dv1 w2 and f2 = du1 w2 - du2 w1 with the edges w1 and w2 from the first corner;
    along f1 v is constant, along f2 u is.

    Args:
        positions: (n, 3).
        uv: (n, 2).
        triangles: (m, 3).

    Returns:
        f1 (m, 3), f2 (m, 3) and du1 dv2 - du2 dv1 (m,), which is negative in mirrored charts.
    """
    place, chart = positions[triangles], uv[triangles]
    edge_1, edge_2 = place[:, 1] - place[:, 0], place[:, 2] - place[:, 0]
    u_1, v_1 = (chart[:, 1] - chart[:, 0]).T[:, :, None]
    u_2, v_2 = (chart[:, 2] - chart[:, 0]).T[:, :, None]
    along_u, along_v = v_2 * edge_1 - v_1 * edge_2, u_1 * edge_2 - u_2 * edge_1
    return along_u, along_v, (u_1 * v_2 - u_2 * v_1)[:, 0]


@dataclass(frozen=True, slots=True)
class _Charts:
    """Of each triangle: a unit vector where u grows, whether u and v give one, whether mirrored."""

    tangents: Floats
    usable: Flags
    mirrored: Flags

    @classmethod
    def of(cls, positions: Floats, uv: Floats, triangles: Indices) -> "_Charts":
        along_u, along_v, determinant = triangle_tangents(positions, uv, triangles)
        length = np.linalg.norm(along_u, axis=1)
        usable = (np.abs(determinant) > _NO_AREA) & (length > _NO_AREA)
        usable &= np.linalg.norm(along_v, axis=1) > _NO_AREA
        mirrored = determinant < 0
        factor = np.where(mirrored, -1.0, 1.0) / np.where(usable, length, 1.0)
        return cls(along_u * factor[:, None], usable, mirrored)


def _groups(places: Floats, welded: Indices, charts: _Charts) -> tuple[Indices, Flags]:
    """Number the groups of corners, and say of each corner whether its chart counts as mirrored.

    A triangle without a direction follows its neighbours: it holds their groups together.
    """
    solid = (places != np.roll(places, -1, axis=1)).any(axis=2).all(axis=1)
    near, far = shared_edges(welded, np.flatnonzero(solid))
    mirrored = _spread(charts, near // 3, far // 3)
    alike = mirrored[near // 3] == mirrored[far // 3]
    near, far = near[alike], far[alike]
    # An edge's start in one triangle is its end in the other.
    starts = np.concatenate([near, following(near)])
    ends = np.concatenate([following(far), far])
    groups = _components(welded.size, starts, ends)
    return groups, np.repeat(mirrored[:, None], 3, axis=1)


def _spread(charts: _Charts, one: Indices, other: Indices) -> Flags:
    """Let triangles without a direction be mirrored as the first neighbour that has one."""
    usable = charts.usable
    unsure = ~usable[one] & ~usable[other]
    patch = _components(len(usable), one[unsure], other[unsure])
    border = np.concatenate(
        [
            np.stack([one, other], axis=1)[~usable[one] & usable[other]],
            np.stack([other, one], axis=1)[~usable[other] & usable[one]],
        ]
    )
    neighbour = np.full(len(usable), len(usable))
    np.minimum.at(neighbour, patch[border[:, 0]], border[:, 1])
    known = np.append(charts.mirrored, False)
    return np.where(usable, charts.mirrored, known[neighbour[patch]])


def _components(count: int, starts: Indices, ends: Indices) -> Indices:
    """Give each of 0..count - 1 the smallest that links lead to."""
    label = np.arange(count)
    while (label[starts] != label[ends]).any():
        smaller = np.minimum(label[starts], label[ends])
        np.minimum.at(label, label[starts], smaller)
        np.minimum.at(label, label[ends], smaller)
        while (label != label[label]).any():
            label = label[label]
    return label


def _sums(mesh: Mesh, corners: Indices, charts: _Charts, groups: Indices) -> Floats:
    """Add up each group's tangents in the plane of the normal, weighted by the angle there."""
    places, normals = mesh.positions[corners], mesh.normals[corners]
    tangents = unit(across(np.repeat(charts.tangents[:, None], 3, axis=1), normals))
    after = unit(across(np.roll(places, -1, axis=1) - places, normals))
    before = unit(across(np.roll(places, 1, axis=1) - places, normals))
    angles = np.arccos(np.clip((after * before).sum(axis=2), -1, 1))
    weighted = (tangents * np.where(charts.usable[:, None], angles, 0.0)[..., None]).reshape(-1, 3)
    return sums(weighted, groups, int(groups.max()) + 1)


def across(vectors: Floats, normals: Floats) -> Floats:
    """Lay vectors into the planes of unit normals."""
    laid: Floats = vectors - (vectors * normals).sum(axis=-1, keepdims=True) * normals
    return laid


def unit(vectors: Floats) -> Floats:
    """Divide by the length; what has none stays."""
    length = np.linalg.norm(vectors, axis=-1, keepdims=True)
    scaled: Floats = vectors / np.where(length > _NO_AREA, length, 1.0)
    return scaled


def or_perpendicular(vectors: Floats, normals: Floats) -> Floats:
    """Give unit vectors; where there is none, the axis least like the normal, laid across it."""
    axis = np.eye(3)[np.argmin(np.abs(normals), axis=1)]
    usable = np.linalg.norm(vectors, axis=1, keepdims=True) > _NO_AREA
    return unit(np.where(usable, vectors, across(axis, normals)))
