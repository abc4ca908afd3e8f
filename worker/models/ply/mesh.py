"""From the tables of a PLY file to a mesh."""

from collections.abc import Mapping
from typing import Final

import numpy as np
from numpy.typing import NDArray

from worker.errors import UnusableAssetError
from worker.geometry.mesh import Mesh, MeshKind
from worker.images.colour import linear_from_srgb
from worker.models.limits import TRIANGLES_MAX, check_positions, check_size, check_uv
from worker.models.ply.body import Table
from worker.models.ply.header import Header
from worker.models.polygons import triangulate
from worker.models.vertices import normalised, number_rows, smooth_normals, used

ELEMENTS: Final = frozenset(("vertex", "face", "tristrips", "edge"))

_FLOAT32_MAX = np.finfo(np.float32).max
_UV_NAMES = (("s", "t"), ("u", "v"), ("texture_u", "texture_v"), ("texture_s", "texture_t"))


def build_mesh(header: Header, tables: Mapping[str, Table]) -> tuple[Mesh, list[str]]:
    """Make triangles of faces and strips, else lines of edges, else points.

    Returns:
        The mesh, and what is left out.

    Raises:
        UnusableAssetError: `asset_unusable` or `asset_too_large`.
    """
    vertices = tables.get("vertex")
    if vertices is None or not vertices.rows:
        raise UnusableAssetError("it has no vertices")
    positions = _columns(vertices, ("x", "y", "z"))
    if positions is None:
        raise UnusableAssetError("its vertices have no x, y and z")
    warnings: list[str] = []
    kind: MeshKind = "triangles"
    corners, faces, wedges = _face_triangles(tables.get("face"), positions, warnings)
    strips = _strip_triangles(tables.get("tristrips"), len(positions))
    if len(strips):
        if len(corners):
            warnings.append("strips are left out beside faces")
        else:
            corners, faces, wedges = strips, None, None
    if not len(corners):
        kind, corners = _edges_or_points(tables.get("edge"), len(positions))
        faces, wedges = None, None
    check_positions(positions[used(corners, len(positions))])
    uv = wedges
    if uv is None and (of_vertex := _uv(vertices)) is not None:
        uv = of_vertex[corners]
    if uv is not None:
        check_uv(uv)
    colours = _colours(header, "vertex", vertices)
    colours = None if colours is None else colours[corners]
    if colours is None and faces is not None:
        of_face = _colours(header, "face", tables["face"])
        colours = None if of_face is None else np.repeat(of_face[faces][:, None], 3, axis=1)
    normals = _normals(vertices, positions, corners, kind)
    return _joined(kind, corners, positions, normals, uv, colours), warnings


def _columns(table: Table, names: tuple[str, ...]) -> NDArray[np.float64] | None:
    if not all(name in table.columns for name in names):
        return None
    return np.stack([table.columns[name] for name in names], axis=1)


def _uv(vertices: Table) -> NDArray[np.float64] | None:
    found = (_columns(vertices, names) for names in _UV_NAMES)
    return next((uv for uv in found if uv is not None), None)


def _face_triangles(
    table: Table | None, positions: NDArray[np.float64], warnings: list[str]
) -> tuple[NDArray[np.int64], NDArray[np.int64] | None, NDArray[np.float64] | None]:
    """Give vertices (m, 3), faces (m,) and texture coordinates (m, 3, 2) of triangles."""
    lists = {} if table is None else table.lists
    corners = lists.get("vertex_indices") or lists.get("vertex_index")
    if corners is None:
        return np.empty((0, 3), np.int64), None, None
    check_size(len(corners.items), 3 * TRIANGLES_MAX, "corners of faces")
    vertices = _indices(corners.items, len(positions))
    sizes = corners.sizes
    whole = sizes > 2
    if not whole.all():
        warnings.append(f"{int((~whole).sum())} faces of fewer than three corners are left out")
    check_size(int((sizes[whole] - 2).sum()), TRIANGLES_MAX, "triangles")
    inside = np.flatnonzero(np.repeat(whole, sizes))
    starts = np.append(0, np.cumsum(sizes[whole]))
    triangles = inside[triangulate(positions, vertices[inside].astype(np.int32), starts)]
    faces = np.repeat(np.flatnonzero(whole), sizes[whole] - 2)
    wedges = lists.get("texcoord")
    uv = None
    if wedges is not None and len(wedges.items) and (wedges.sizes == 2 * sizes).all():
        uv = wedges.items.reshape(-1, 2)[triangles]
    return vertices[triangles], faces, uv


def _strip_triangles(table: Table | None, vertex_count: int) -> NDArray[np.int64]:
    """Give the vertices (m, 3) of the triangles of strips, parted by -1; every second is turned."""
    lists = {} if table is None else table.lists
    strips = lists.get("vertex_indices") or lists.get("vertex_index")
    if strips is None or len(strips.items) < 3:
        return np.empty((0, 3), np.int64)
    check_size(len(strips.items), TRIANGLES_MAX, "corners of strips")
    begins = np.zeros(len(strips.items), np.bool_)
    begins[strips.starts[:-1][strips.sizes > 0]] = True
    parted = strips.items == -1
    begins[1:] |= parted[:-1]
    number = np.arange(len(begins))
    first = np.maximum.accumulate(np.where(begins, number, 0))
    vertices = np.where(parted, -1, _indices(np.where(parted, 0, strips.items), vertex_count))
    ahead = number[:-2]
    same = (first[ahead] == first[ahead + 2]) & ~(parted[ahead] | parted[ahead + 1])
    ahead = ahead[same & ~parted[2:]]
    odd = (ahead - first[ahead]) % 2
    rows = np.stack([vertices[ahead + odd], vertices[ahead + 1 - odd], vertices[ahead + 2]], axis=1)
    a, b, c = rows.T
    return np.asarray(rows[(a != b) & (b != c) & (c != a)])


def _edges_or_points(table: Table | None, vertex_count: int) -> tuple[MeshKind, NDArray[np.int64]]:
    ends = None if table is None else _columns(table, ("vertex1", "vertex2"))
    if ends is None or not len(ends):
        return "points", np.arange(vertex_count)[:, None]
    return "lines", _indices(ends, vertex_count)


def _indices(numbers: NDArray[np.float64], count: int) -> NDArray[np.int64]:
    """Take numbers as indices of vertices.

    Raises:
        UnusableAssetError: One names a vertex that is not there.
    """
    if not ((numbers >= 0) & (numbers < count)).all():
        raise UnusableAssetError(f"a face or edge names none of its {count} vertices")
    return numbers.astype(np.int64)


def _colours(header: Header, name: str, table: Table) -> NDArray[np.float64] | None:
    """Linear colours (n, 4) of the rows of an element, if it has any."""
    colours = _columns(table, ("red", "green", "blue"))
    if colours is None:
        return None
    element = next(element for element in header.elements if element.name == name)
    types = {p.name: p.type for p in element.properties}
    scaled = np.ones((len(colours), 4))
    if (most := _largest(types["red"])) > 1:
        scaled[:, :3] = linear_from_srgb(np.clip(colours / most, 0.0, 1.0))
    else:
        scaled[:, :3] = np.clip(np.nan_to_num(colours, nan=0.0), 0.0, _FLOAT32_MAX)
    if "alpha" in table.columns:
        alpha = np.nan_to_num(table.columns["alpha"], nan=1.0) / _largest(types["alpha"])
        scaled[:, 3] = np.clip(alpha, 0.0, 1.0)
    return scaled


def _largest(number: np.dtype[np.generic]) -> int:
    """Give the largest whole number of a type; 1 for floats."""
    bits = 8 * number.itemsize
    if number.kind == "f":
        return 1
    return int(2 ** (bits if number.kind == "u" else bits - 1)) - 1


def _normals(
    vertices: Table,
    positions: NDArray[np.float64],
    corners: NDArray[np.int64],
    kind: MeshKind,
) -> NDArray[np.float64]:
    """Normals (n, 3) of the vertices; where there are none, smooth ones, and zeros off faces."""
    given = _columns(vertices, ("nx", "ny", "nz"))
    if given is None:
        given = np.zeros_like(positions)
    lengths = np.abs(given).max(axis=1)
    without = ~((lengths > 0) & (lengths <= _FLOAT32_MAX))
    normals = normalised(given)
    if kind != "triangles":
        normals[without] = 0.0
    elif without[corners].any():
        smooth = smooth_normals(positions, corners, corners, len(positions))
        normals[without] = smooth[without]
    return normals


def _joined(
    kind: MeshKind,
    corners: NDArray[np.int64],
    positions: NDArray[np.float64],
    normals: NDArray[np.float64],
    uv: NDArray[np.float64] | None,
    colours: NDArray[np.float64] | None,
) -> Mesh:
    """Join the corners that are equal in everything: (m, k), uv (m, k, 2), colours (m, k, 4)."""
    keys = [corners.reshape(-1, 1)]
    for attribute in (uv, colours):
        if attribute is not None:
            plain = attribute.reshape(corners.size, -1) + 0.0  # there is no -0
            keys.append(np.ascontiguousarray(plain).view(np.int64))
    number, firsts = number_rows(np.concatenate(keys, axis=1))
    vertex = corners.ravel()[firsts]
    return Mesh(
        positions=positions[vertex],
        normals=normals[vertex],
        uv_sets=() if uv is None else (uv.reshape(-1, 2)[firsts],),
        triangles=number.reshape(corners.shape).astype(np.uint32),
        colors=None if colours is None else colours.reshape(-1, 4)[firsts],
        kind=kind,
    )
