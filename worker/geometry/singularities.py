"""Where a mesh has no direction of u: what Poincare and Hopf say must be on most closed surfaces.

The direction of each triangle is compared with that of its neighbours, unfolded into one plane.
What it has turned after a walk round a vertex, plus what the surface itself turns there (2 pi less
the angles), is a whole number of turns: the vertex's index. Over a closed surface the indices add
up to its Euler characteristic: 2 for a ball, 0 for a ring.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from worker.geometry.mesh import Mesh
from worker.geometry.tangents import triangle_tangents, unit
from worker.geometry.topology import Floats, Indices, following, shared_edges, weld

_TOLD = 32
"""How many singular places are told one by one."""
_NO_AREA = float(np.finfo(np.float32).tiny)


@dataclass(frozen=True, slots=True)
class Singularities:
    """What is known of the directions of u on a mesh.

    Attributes:
        places: (k, 3), where there is no direction, in the mesh's frame.
        indices: (k,), how often directions turn round each of them.
        mirrored: How many triangles show the picture mirrored.
        degenerate: How many show no area of it.
        index_sum: Of a closed mesh the sum of all indices.
    """

    places: Floats
    indices: Indices
    mirrored: int
    degenerate: int
    index_sum: int | None

    def as_report(self) -> Mapping[str, Any]:
        """Return it as JSON-able data; of many places the first ones."""
        found = zip(self.places[:_TOLD].tolist(), self.indices[:_TOLD].tolist(), strict=True)
        return {
            "singular_vertices": len(self.places),
            "singular": [{"position": place, "index": index} for place, index in found],
            "index_sum": self.index_sum,
            "mirrored_triangles": self.mirrored,
            "degenerate_triangles": self.degenerate,
        }


def singularities(mesh: Mesh, uv_set: int = 0) -> Singularities:
    """Find where a mesh of triangles has no direction of u; vertices at one place are one."""
    corners = mesh.triangles.astype(np.int64)
    along_u, _, determinant = triangle_tangents(mesh.positions, mesh.uv(uv_set), corners)
    welded = weld(mesh.positions)
    places = mesh.positions[np.unique(welded, return_index=True)[1]]
    facets = np.cross(
        mesh.positions[corners[:, 1]] - mesh.positions[corners[:, 0]],
        mesh.positions[corners[:, 2]] - mesh.positions[corners[:, 0]],
    )
    solid = np.linalg.norm(facets, axis=1) > _NO_AREA
    forward = along_u * np.sign(determinant)[:, None]
    used = np.flatnonzero(solid)
    turns, inner = _turns(places, welded[corners], forward, unit(facets), used)
    indices = np.rint(turns / (2 * np.pi)).astype(np.int64)
    indices[~inner] = 0
    singular = np.flatnonzero(indices)
    touched = np.unique(welded[corners[solid]])
    return Singularities(
        places=places[singular],
        indices=indices[singular],
        mirrored=int(np.count_nonzero(determinant < 0)),
        degenerate=int(np.count_nonzero(np.abs(determinant) <= _NO_AREA)),
        index_sum=int(indices.sum()) if touched.size and inner[touched].all() else None,
    )


def _turns(
    places: Floats, corners: Indices, directions: Floats, normals: Floats, used: Indices
) -> tuple[Floats, np.ndarray]:
    """Return how far directions turn round each place, and which places have triangles all round.

    Args:
        places: (n, 3).
        corners: (m, 3), numbers of places.
        directions: (m, 3), where u grows on each triangle.
        normals: (m, 3), of length 1.
        used: Which triangles have an area.
    """
    near, far = shared_edges(corners, used)
    start, end = corners.ravel()[near], corners.ravel()[far]
    edge = unit(places[end] - places[start])

    def angle(triangles: Indices) -> Floats:
        aside = np.cross(normals[triangles], edge)
        along = directions[triangles]
        found: Floats = np.arctan2((along * aside).sum(axis=1), (along * edge).sum(axis=1))
        return found

    # Counter-clockwise round its start, one comes from the far side of the edge to the near one.
    turned = (angle(near // 3) - angle(far // 3) + np.pi) % (2 * np.pi) - np.pi
    turns = np.full(len(places), 2 * np.pi)
    turns += np.bincount(start, turned, minlength=len(places))
    turns -= np.bincount(end, turned, minlength=len(places))
    here = places[corners[used]]
    after = unit(np.roll(here, -1, axis=1) - here)
    before = unit(np.roll(here, 1, axis=1) - here)
    wide = np.arccos(np.clip((after * before).sum(axis=2), -1, 1))
    turns -= np.bincount(corners[used].ravel(), wide.ravel(), minlength=len(places))
    paired = np.zeros(corners.size, dtype=bool)
    paired[near] = paired[far] = True
    alone = (used[:, None] * 3 + np.arange(3)).ravel()
    alone = alone[~paired[alone]]
    inner = np.ones(len(places), dtype=bool)
    inner[corners.ravel()[alone]] = inner[corners.ravel()[following(alone)]] = False
    return turns, inner
