"""From the statements of an OBJ file to meshes, one for each group and material."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from worker.geometry.mesh import Mesh, MeshKind
from worker.images.colour import linear_from_srgb
from worker.models.limits import TRIANGLES_MAX, VERTICES_MAX, check_size
from worker.models.obj import scan as obj_scan
from worker.models.polygons import triangulate
from worker.models.vertices import normalised, number_rows, smooth_normals


@dataclass(frozen=True, slots=True)
class Piece:
    """What one group has of one material; -1 is no group, no material."""

    mesh: Mesh
    group: int
    material: int


@dataclass(frozen=True, slots=True)
class Statements:
    """What a file says, as arrays.

    Attributes:
        vertices: (n, 7): x, y, z, red, green, blue, and how many of them were given.
        texture_vertices: (n, 2).
        normals: (n, 3).
        corners: (k, 3): indices of the three above; -1 is none.
        kinds: (e,): whether each element is a face, a line or a point.
        starts: (e + 1,): where the corners of each begin, and the end.
        smoothing: (e,): the smoothing group of each; 0 is off, -1 was never said.
    """

    vertices: NDArray[np.float64]
    texture_vertices: NDArray[np.float64]
    normals: NDArray[np.float64]
    corners: NDArray[np.int32]
    kinds: NDArray[np.int32]
    starts: NDArray[np.int64]
    smoothing: NDArray[np.int32]

    @property
    def sizes(self) -> NDArray[np.int64]:
        """How many corners each element has."""
        return np.diff(self.starts)


@dataclass(frozen=True, slots=True)
class _Cells:
    """Triangles, lines or points: rows of corners, the element of each, and a normal per corner."""

    kind: MeshKind
    rows: NDArray[np.int64]
    elements: NDArray[np.int64]
    normal_of: NDArray[np.int64]
    normals: NDArray[np.float64]


def build_pieces(
    statements: Statements, owners: NDArray[np.int64], chosen: NDArray[np.int64]
) -> tuple[Piece, ...]:
    """Make the meshes.

    Args:
        statements: The file.
        owners: (e, 3) of each element: its kind, group and material.
        chosen: Which elements to draw: faces of three corners or more, lines of two or more.

    Raises:
        UnusableAssetError: `asset_too_large`.
    """
    kinds = statements.kinds[chosen]
    all_cells = (
        _triangles(statements, chosen[kinds == obj_scan.FACE]),
        _segments(statements, chosen[kinds == obj_scan.LINE]),
        _points(statements, chosen[kinds == obj_scan.POINT]),
    )
    colours = _colours(statements.vertices)
    pieces = []
    for cells in all_cells:
        owner, firsts = number_rows(owners[cells.elements])
        order = np.argsort(owner, kind="stable")
        ends = np.searchsorted(owner[order], np.arange(len(firsts) + 1))
        for number, first in enumerate(firsts.tolist()):
            mesh = _mesh(statements, colours, cells, order[ends[number] : ends[number + 1]])
            _kind, group, material = owners[cells.elements[first]].tolist()
            pieces.append(Piece(mesh, group, material))
    return tuple(pieces)


def _triangles(statements: Statements, faces: NDArray[np.int64]) -> _Cells:
    sizes = statements.sizes[faces]
    check_size(int((sizes - 2).sum()), TRIANGLES_MAX, "triangles")
    positions = np.ascontiguousarray(statements.vertices[:, :3])
    corners = _corners_of(statements, faces)
    starts = np.append(0, np.cumsum(sizes))
    of_face = np.ascontiguousarray(statements.corners[corners, 0])
    rows = corners[triangulate(positions, of_face, starts)]
    elements = np.repeat(faces, sizes - 2)
    given = normalised(statements.normals)
    without = ~(np.abs(statements.normals).max(axis=1, initial=0.0) > 0)  # zero or no number
    numbers = np.append(np.where(without, -1, np.arange(len(given))), -1)
    normal_of = numbers[statements.corners[rows, 2]]
    if not (normal_of < 0).any():
        return _Cells("triangles", rows, elements, normal_of, given)
    vertices = statements.corners[rows, 0].astype(np.int64)
    group = statements.smoothing[elements].astype(np.int64)
    flat = group == 0
    joints = np.where(flat, -1 - elements, 0)[:, None] + np.where(flat[:, None], 0, vertices)
    keys = np.stack([joints, np.broadcast_to(group[:, None], joints.shape)], axis=2)
    joint, firsts = number_rows(keys.reshape(-1, 2))
    smooth = smooth_normals(positions, vertices, joint.reshape(-1, 3), len(firsts))
    computed = len(given) + joint.reshape(-1, 3)
    return _Cells(
        "triangles",
        rows,
        elements,
        np.where(normal_of < 0, computed, normal_of),
        np.concatenate([given, smooth]),
    )


def _segments(statements: Statements, lines: NDArray[np.int64]) -> _Cells:
    sizes = statements.sizes[lines]
    check_size(int((sizes - 1).sum()), VERTICES_MAX, "pieces of lines")
    corners = _corners_of(statements, lines)
    is_start = np.ones(len(corners), np.bool_)
    is_start[np.cumsum(sizes) - 1] = False
    starts = np.flatnonzero(is_start)
    rows = np.stack([corners[starts], corners[starts + 1]], axis=1)
    return _without_normals("lines", rows, np.repeat(lines, sizes - 1))


def _points(statements: Statements, points: NDArray[np.int64]) -> _Cells:
    rows = _corners_of(statements, points)[:, None]
    check_size(len(rows), VERTICES_MAX, "points")
    return _without_normals("points", rows, np.repeat(points, statements.sizes[points]))


def _without_normals(
    kind: MeshKind, rows: NDArray[np.int64], elements: NDArray[np.int64]
) -> _Cells:
    return _Cells(kind, rows, elements, np.zeros_like(rows), np.zeros((1, 3)))


def _corners_of(statements: Statements, elements: NDArray[np.int64]) -> NDArray[np.int64]:
    """List the corners of some elements, one element after the other."""
    chosen = np.zeros(len(statements.kinds), np.bool_)
    chosen[elements] = True
    return np.flatnonzero(np.repeat(chosen, statements.sizes))


def _colours(vertices: NDArray[np.float64]) -> NDArray[np.float64] | None:
    """Linear colours (n, 4), if any vertex has one; the others are white."""
    has_one = vertices[:, 6] == 6
    if not has_one.any():
        return None
    colours = np.ones((len(vertices), 4))
    encoded = np.nan_to_num(vertices[has_one, 3:6], nan=1.0)
    colours[has_one, :3] = linear_from_srgb(np.clip(encoded, 0.0, 1.0))
    return colours


def _mesh(
    statements: Statements,
    colours: NDArray[np.float64] | None,
    cells: _Cells,
    chosen: NDArray[np.int64],
) -> Mesh:
    """Join the corners of chosen cells that are equal in everything."""
    corners = statements.corners[cells.rows[chosen]].reshape(-1, 3).astype(np.int64)
    corners[:, 2] = cells.normal_of[chosen].ravel()
    number, firsts = number_rows(corners)
    vertex, textured, normal = corners[firsts].T
    uv_sets: tuple[NDArray[np.float64], ...] = ()
    if (textured >= 0).any():
        with_none = np.concatenate([statements.texture_vertices, np.zeros((1, 2))])
        uv_sets = (with_none[textured],)
    return Mesh(
        positions=statements.vertices[vertex, :3],
        normals=cells.normals[normal],
        uv_sets=uv_sets,
        triangles=number.reshape(len(chosen), -1).astype(np.uint32),
        colors=None if colours is None else colours[vertex],
        kind=cells.kind,
    )
