"""Wavefront OBJ: polygons with shared vertices, in groups with materials.

Every group (g or o) becomes a node, and every material of a group a part. Normals are those of the
file; where it has none, they are smooth over faces of one smoothing group that share a vertex
(by its index), weighted with the angles there; `s off` is flat, and without any s all is smooth.
Colours after a vertex are sRGB, as the 8-bit colours they come from (so writes Blender). Free-form
curves and surfaces are not drawn. Unused vertices do not count.

Source: Wavefront Technologies, Advanced Visualizer, appendix B1, version 3.0, 1995.
"""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from worker.errors import UnusableAssetError
from worker.models.limits import (
    TRIANGLES_MAX,
    VERTICES_MAX,
    WARNINGS_MAX,
    check_positions,
    check_size,
    check_uv,
)
from worker.models.model import Model, Part
from worker.models.obj import mtl
from worker.models.obj import scan as obj_scan
from worker.models.obj.pieces import Piece, Statements, build_pieces
from worker.models.obj.surfaces import surfaces_of
from worker.models.outline import Outline, outline_of
from worker.models.siblings import NAME_LENGTH_MAX, decoded, sibling_name
from worker.models.vertices import number_rows, used

GROUPS_MAX = 500
"""Parts of one file: each costs about a millisecond to draw. Beyond, groups are joined."""
LIBRARIES_MAX = 256
"""As many files as a request may give beside a model."""
MATERIALS_MAX = 4096
"""Parts when groups are joined."""


@dataclass(frozen=True, slots=True)
class ObjFile:
    """An OBJ file by itself, before its materials are known."""

    pieces: tuple[Piece, ...]
    groups: tuple[str, ...]
    materials: tuple[str, ...]
    libraries: tuple[str, ...]
    has_normals: bool
    warnings: tuple[str, ...]


def is_obj(data: bytes) -> bool:
    """Whether a text holds statements of vertices and of faces, lines or points."""
    counts = obj_scan.count(_text(data))
    drawn = counts[[obj_scan.FACE, obj_scan.LINE, obj_scan.POINT, obj_scan.FREE_FORM]].sum()
    return bool(counts[obj_scan.VERTEX] > 0 and drawn > 0)


def read(data: bytes, files: Mapping[str, bytes]) -> Model:
    """Read an OBJ with the material libraries and pictures of its set.

    Raises:
        UnusableAssetError: As `parse`, and as `surfaces_of`.
        AssetMissingError: `asset_file_missing`: the set lacks a library or a picture.
    """
    parsed = parse(data)
    library = mtl.library(parsed.libraries, files)
    made = surfaces_of(parsed.materials, library, files)
    return Model(
        parts=tuple(
            Part(
                mesh=piece.mesh,
                matrix=np.eye(4),
                node=None if piece.group < 0 else piece.group,
                material=None if piece.material < 0 else piece.material,
                key=str(index),
            )
            for index, piece in enumerate(parsed.pieces)
        ),
        node_names=parsed.groups,
        surfaces=tuple(made.surfaces),
        cameras=(),
        lights=(),
        pictures=made.pictures,
        warnings=(*parsed.warnings, *made.warnings)[:WARNINGS_MAX],
    )


def outline(data: bytes) -> Outline:
    """Measure an OBJ without its materials.

    Raises:
        UnusableAssetError: As `parse`; also if a material library's name cannot be one.
    """
    parsed = parse(data)
    libraries = [name for line in parsed.libraries for name in mtl.library_names(line)]
    check_size(len(libraries), LIBRARIES_MAX, "material libraries")
    return outline_of(
        [piece.mesh for piece in parsed.pieces],
        has_normals=parsed.has_normals,
        materials=parsed.materials,
        nodes=parsed.groups,
        files=tuple(dict.fromkeys(sibling_name(name) for name in libraries)),
        warnings=parsed.warnings,
    )


def parse(data: bytes) -> ObjFile:
    """Read an OBJ alone.

    Raises:
        UnusableAssetError: `asset_unusable`, `asset_unsupported` for free-form geometry alone, or
            `asset_too_large`.
    """
    text = _text(data)
    counts = obj_scan.count(text)
    _check(counts)
    elements = np.empty((counts[_DRAWN].sum(), 5), np.int32)
    names = int(counts[obj_scan.MATERIAL] + counts[obj_scan.GROUP])
    marks = np.empty((min(names, 2 * len(elements)), 2), np.int64)
    libraries = np.empty((min(counts[obj_scan.LIBRARY], obj_scan.LIBRARIES_MAX), 2), np.int64)
    vertices = np.empty((counts[obj_scan.VERTEX], 7))
    texture_vertices = np.empty((counts[obj_scan.TEXTURE_VERTEX], 2))
    normals = np.empty((counts[obj_scan.NORMAL], 3))
    corners = np.empty((counts[obj_scan.CORNERS], 3), np.int32)
    wrong, line, marked = obj_scan.fill(
        text, vertices, texture_vertices, normals, corners, elements, marks, libraries
    )
    if wrong == obj_scan.NOT_AN_INDEX:
        raise UnusableAssetError(f"line {line}: a corner is not of the form v, v/vt or v/vt/vn")
    if wrong == obj_scan.NO_SUCH_VERTEX:
        raise UnusableAssetError(f"line {line}: a corner names what is not there")
    statements = Statements(
        vertices,
        texture_vertices,
        normals,
        corners,
        kinds=elements[:, 0],
        starts=np.append(elements[:, 1].astype(np.int64), len(corners)),
        smoothing=elements[:, 2],
    )
    _check_numbers(statements)
    written = [decoded(data_slice) for data_slice in _slices(text, marks[:marked])]
    material, materials = _named(elements[:, 3], written)
    group, groups = _named(elements[:, 4], written)
    warnings = []
    owners = np.stack([elements[:, 0], group, material], axis=1).astype(np.int64)
    if len(number_rows(owners)[1]) > GROUPS_MAX:
        warnings.append(f"its groups are joined: they have more than {GROUPS_MAX} parts")
        owners[:, 1], groups = -1, ()
        check_size(len(number_rows(owners)[1]), MATERIALS_MAX, "materials")
    if counts[obj_scan.FREE_FORM]:
        warnings.append("free-form curves and surfaces are not drawn")
    short = statements.sizes < np.choose(statements.kinds - obj_scan.FACE, (3, 2, 1))
    if short.any():
        warnings.append(f"{int(short.sum())} faces and lines of too few corners are left out")
    pieces = build_pieces(statements, owners, np.flatnonzero(~short))
    if not pieces:
        raise UnusableAssetError("it has no faces of three corners or more")
    return ObjFile(
        pieces,
        groups,
        materials,
        tuple(decoded(name) for name in _slices(text, libraries)),
        bool((corners[:, 2] >= 0).any()),
        tuple(warnings),
    )


_DRAWN = [obj_scan.FACE, obj_scan.LINE, obj_scan.POINT]


def _text(data: bytes) -> NDArray[np.uint8]:
    """Drop a byte order mark, and make one of lines that go on after a backslash."""
    data = data.removeprefix(b"\xef\xbb\xbf")
    if b"\\" in data:
        data = data.replace(b"\\\r\n", b"   ").replace(b"\\\n", b"  ").replace(b"\\\r", b"  ")
    return np.frombuffer(data, np.uint8)


def _slices(text: NDArray[np.uint8], bounds: NDArray[np.int64]) -> list[bytes]:
    return [text[start:stop].tobytes() for start, stop in bounds.tolist()]


def _check(counts: NDArray[np.int64]) -> None:
    check_size(int(counts[obj_scan.VERTEX]), VERTICES_MAX, "vertices")
    check_size(int(counts[obj_scan.TEXTURE_VERTEX]), VERTICES_MAX, "texture vertices")
    check_size(int(counts[obj_scan.NORMAL]), VERTICES_MAX, "normals")
    check_size(int(counts[_DRAWN].sum()), TRIANGLES_MAX, "faces, lines and points")
    check_size(int(counts[obj_scan.CORNERS]), 3 * TRIANGLES_MAX, "corners of faces")
    if not counts[_DRAWN].sum():
        if counts[obj_scan.FREE_FORM]:
            raise UnusableAssetError(
                "it has only free-form curves and surfaces", code="asset_unsupported"
            )
        raise UnusableAssetError("it has no faces, lines or points")


def _check_numbers(statements: Statements) -> None:
    vertices, texture_vertices = statements.vertices, statements.texture_vertices
    check_positions(vertices[used(statements.corners[:, 0], len(vertices)), :3])
    check_uv(texture_vertices[used(statements.corners[:, 1], len(texture_vertices))])


def _named(
    marks: NDArray[np.int32], written: list[str]
) -> tuple[NDArray[np.int32], tuple[str, ...]]:
    """Turn numbers of marks into numbers of names, in the order in which they are first used."""
    names: dict[str, int] = {}
    number = np.full(len(written) + 1, -1, np.int32)  # the last one is for -1: no mark
    for mark in np.flatnonzero(used(marks, len(written))).tolist():
        name = written[mark][:NAME_LENGTH_MAX] or "default"
        number[mark] = names.setdefault(name, len(names))
    return number[marks], tuple(names)
