"""Halves edges, each by itself, so that the triangles on both of its sides decide alike."""

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from worker.geometry.mesh import Mesh
from worker.geometry.topology import Floats, Indices

_NO_LENGTH = float(np.finfo(np.float32).tiny)
Flags = NDArray[np.bool_]


def subdivided(mesh: Mesh, levels: int, longest_edge: float | None = None) -> Mesh:
    """Halve every edge that is longer than allowed, up to so many times.

    An edge is judged by its ends alone, and its middle is the same from both sides to the last
    bit: no cracks open, not even where a chart ends and vertices lie twice in one place. Tangents
    are left out; they are found anew where they are needed.

    Args:
        mesh: Lines and points stay as they are.
        levels: How often all edges are looked at.
        longest_edge: In the mesh's units; without it every edge is halved each time.
    """
    if mesh.kind != "triangles":
        return mesh
    mesh = replace(mesh, tangents=None)
    for _ in range(levels):
        corners = mesh.triangles.astype(np.int64)
        ends, edges = _edges(corners, len(mesh.positions))
        halved = np.ones(len(ends), dtype=bool)
        if longest_edge is not None:
            apart = mesh.positions[ends[:, 1]] - mesh.positions[ends[:, 0]]
            halved = (apart * apart).sum(axis=1) > longest_edge**2
        if not halved.any():
            break
        mesh = _with_middles(mesh, corners, ends, edges, halved)
    return mesh


def _edges(corners: Indices, vertices: int) -> tuple[Indices, Indices]:
    """Return the ends (k, 2) of each edge, and the edges (m, 3) from corner i to corner i + 1."""
    start, end = corners, np.roll(corners, -1, axis=1)
    keys = np.minimum(start, end) * vertices + np.maximum(start, end)
    found, edges = np.unique(keys, return_inverse=True)
    return np.stack(np.divmod(found, vertices), axis=1), edges.reshape(corners.shape)


def _with_middles(
    mesh: Mesh, corners: Indices, ends: Indices, edges: Indices, halved: Flags
) -> Mesh:
    def grown(values: Floats) -> Floats:
        one, other = values[ends[halved, 0]], values[ends[halved, 1]]
        return np.concatenate([values, one / 2 + other / 2])

    normals = grown(mesh.normals)
    length = np.linalg.norm(normals, axis=1, keepdims=True)
    number = len(mesh.positions) + np.cumsum(halved) - 1
    middles = np.where(halved, number, -1)[edges]
    return replace(
        mesh,
        positions=grown(mesh.positions),
        normals=np.divide(normals, length, out=normals, where=length > _NO_LENGTH),
        uv_sets=tuple(grown(uv) for uv in mesh.uv_sets),
        colors=None if mesh.colors is None else grown(mesh.colors),
        triangles=_split(corners, middles).astype(np.uint32),
    )


def _split(corners: Indices, middles: Indices) -> Indices:
    """Return the triangles (m, 3) cut at the middles (m, 3) of their edges, -1 where there is none.

    Each is turned first so that its first edge is halved and, of three, its last one is not.
    """
    cut = middles >= 0
    count = cut.sum(axis=1)
    turn = np.where(count == 1, np.argmax(cut, axis=1), (np.argmin(cut, axis=1) + 1) % 3)
    order = (np.arange(3) + np.where(count == 3, 0, turn)[:, None]) % 3
    a, b, c = np.take_along_axis(corners, order, axis=1).T
    ab, bc, ca = np.take_along_axis(middles, order, axis=1).T
    pieces = [
        (count == 0, (a, b, c)),
        (count == 1, (a, ab, c)),
        (count == 1, (ab, b, c)),
        (count >= 2, (ab, b, bc)),
        (count == 2, (a, ab, bc)),
        (count == 2, (a, bc, c)),
        (count == 3, (a, ab, ca)),
        (count == 3, (ca, bc, c)),
        (count == 3, (ab, bc, ca)),
    ]
    return np.concatenate([np.stack(piece, axis=1)[chosen] for chosen, piece in pieces])
