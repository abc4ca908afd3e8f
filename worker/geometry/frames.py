"""Directions of u and v on a surface: of a sphere, of any parametrisation, of a mesh.

Source: Hughes et al., 2013, section 20.3 (equations 20.5 and 20.6, and what follows them).
"""

from dataclasses import replace

import numpy as np

from api_schemas.relief import TangentFrames
from worker.geometry.mesh import Mesh
from worker.geometry.tangents import (
    across,
    or_perpendicular,
    triangle_tangents,
    unit,
    with_tangents,
)
from worker.geometry.topology import Floats, sums, weld

_NOTHING = 1e-9
"""Share of its parts' length below which a sum has vanished."""


def framed(mesh: Mesh, frames: TangentFrames, uv_set: int) -> Mesh:
    """Return the mesh with tangents; one that has them, or no triangles, as it is.

    Args:
        mesh: Its vertices may be split.
        frames: mikktspace; averaged, the mean of the triangles that share a vertex, weighted by
            their size on the picture; or sphere, the parallels of a globe round the y axis.
        uv_set: Which texture coordinates say where u grows.
    """
    if frames == "mikktspace":
        return with_tangents(mesh, uv_set)
    if mesh.tangents is not None or mesh.kind != "triangles" or not mesh.triangles.size:
        return mesh
    corners = mesh.triangles.astype(np.int64)
    along_u, _, determinant = triangle_tangents(mesh.positions, mesh.uv(uv_set), corners)
    mirrored = np.repeat(determinant < 0, 3)
    parts = np.repeat(along_u * np.where(determinant < 0, -1.0, 1.0)[:, None], 3, axis=0)
    vertex_and_side = 2 * corners.ravel() + mirrored
    kept, place = np.unique(vertex_and_side, return_inverse=True)
    vertices = kept // 2
    rows = np.hstack([mesh.positions, mesh.normals, mesh.uv(uv_set)])[vertices]
    groups = weld(np.column_stack([rows, kept % 2]))
    ways = sums(parts, groups[place], int(groups.max()) + 1)[groups]
    if frames == "sphere":
        ways = _parallels(mesh.positions[vertices], ways)
    tangents = np.empty((len(kept), 4))
    tangents[:, :3] = or_perpendicular(
        across(unit(ways), mesh.normals[vertices]), mesh.normals[vertices]
    )
    tangents[:, 3] = np.where(kept % 2, -1.0, 1.0)
    return replace(
        mesh,
        positions=mesh.positions[vertices],
        normals=mesh.normals[vertices],
        uv_sets=tuple(uv[vertices] for uv in mesh.uv_sets),
        triangles=place.reshape(corners.shape).astype(np.uint32),
        tangents=tangents,
        colors=None if mesh.colors is None else mesh.colors[vertices],
    )


def sphere_frame(longitude: Floats, latitude: Floats) -> tuple[Floats, Floats, Floats]:
    """Return P, f1 = dP / d longitude and f2 = dP / d latitude on the unit sphere, each (n, 3).

    P = (cos t cos p, sin p, sin t cos p). f1 has the length cos p, and none at the poles; f1 x f2
    points inwards.
    """
    sin_t, cos_t = np.sin(longitude), np.cos(longitude)
    sin_p, cos_p = np.sin(latitude), np.cos(latitude)
    nothing = np.zeros_like(sin_t)
    place = np.stack([cos_t * cos_p, sin_p, sin_t * cos_p], axis=-1)
    east = np.stack([-sin_t * cos_p, nothing, cos_t * cos_p], axis=-1)
    north = np.stack([-cos_t * sin_p, cos_p, -sin_t * sin_p], axis=-1)
    return place, east, north


def surface_frame(
    along_u: Floats, along_v: Floats, normals: Floats
) -> tuple[Floats, Floats, Floats]:
    """Return e1 = P_u / |P_u|, e2 = w (n x e1) and w, the sign of det(P_u, P_v, n).

    Args:
        along_u: P_u, (n, 3).
        along_v: P_v, (n, 3).
        normals: (n, 3), of length 1.

    Returns:
        e1 and e2 (n, 3), w (n,). w is 0, and e1 and e2 are 0, where P_u and P_v are parallel or
        one of them has no length: there is no frame.
    """
    area = np.cross(along_u, along_v)
    size = np.linalg.norm(along_u, axis=-1) * np.linalg.norm(along_v, axis=-1)
    known = np.linalg.norm(area, axis=-1) > _NOTHING * size
    side = np.where(known, np.sign((area * normals).sum(axis=-1)), 0.0)
    first = unit(across(along_u, normals)) * np.abs(side)[..., None]
    return first, side[..., None] * np.cross(normals, first), side


def _parallels(places: Floats, ways: Floats) -> Floats:
    """Return where u grows along the parallels of a globe; at the poles, as the ways lead."""
    x, y, z = places.T
    east = np.stack([-z, 0 * y, x], axis=1)
    away = np.linalg.norm(east, axis=1) > _NOTHING * np.linalg.norm(places, axis=1)
    forward = np.where((east * ways).sum(axis=1) < 0, -1.0, 1.0)
    found: Floats = np.where(away[:, None], east * forward[:, None], ways)
    return found
