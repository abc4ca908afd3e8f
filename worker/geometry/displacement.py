"""Vertices moved along their normals by heights, without cracks."""

from dataclasses import replace

import numpy as np

from worker.geometry.mesh import Mesh
from worker.geometry.tangents import unit
from worker.geometry.topology import Floats, Indices, sums, weld

_NO_LENGTH = 1e-30


def displaced(mesh: Mesh, heights: Floats) -> Mesh:
    """Move each vertex outwards; vertices at one place go together, by the mean of their ways.

    Normals lean as those of the triangles round them do: a mesh that is not moved, or moved alike
    everywhere, keeps its own, however coarse it is. Edges that were sharp stay sharp. Tangents are
    left out.

    Args:
        mesh: Triangles; anything else stays as it is.
        heights: (n,), in the mesh's units.
    """
    if mesh.kind != "triangles" or not mesh.triangles.size:
        return mesh
    places = weld(mesh.positions)
    together = np.bincount(places)
    ways = sums(mesh.normals * heights[:, None], places, len(together)) / together[:, None]
    positions = mesh.positions + ways[places]
    smooth = weld(np.hstack([mesh.positions, mesh.normals]))
    before = _facet_means(mesh.positions, mesh.triangles.astype(np.int64), smooth)
    after = _facet_means(positions, mesh.triangles.astype(np.int64), smooth)
    normals = mesh.normals + after - before
    known = np.linalg.norm(normals, axis=1, keepdims=True) > _NO_LENGTH
    return replace(
        mesh,
        positions=positions,
        normals=np.where(known, unit(normals), mesh.normals),
        tangents=None,
    )


def _facet_means(positions: Floats, corners: Indices, groups: Indices) -> Floats:
    """Return for each vertex the unit mean of the triangles round its group, weighted by area."""
    a, b, c = np.moveaxis(positions[corners], 1, 0)
    facets = np.cross(b - a, c - a)
    means = sums(np.repeat(facets, 3, axis=0), groups[corners].ravel(), int(groups.max()) + 1)
    length = np.linalg.norm(means, axis=1, keepdims=True)
    unit_means = np.divide(means, length, out=np.zeros_like(means), where=length > _NO_LENGTH)
    spread: Floats = unit_means[groups]
    return spread
