"""PLY: vertices, and faces, strips, edges or nothing between them.

Normals are those of the vertices, else smooth over faces that share a vertex, weighted with the
angles there. Texture coordinates are those of the vertices (s t, u v, texture_u texture_v) or of
the corners of faces (texcoord, as MeshLab writes them). Colours of vertices or faces are sRGB where
they are whole numbers, as cameras and screens have them, and linear where they are floats. The
picture that MeshLab names in a comment is worn if it is in the set.
"""

from collections.abc import Mapping

import numpy as np

from api_schemas.maps import ColorMap
from api_schemas.surfaces.phong import PhongSpec
from worker.models.model import Model, NamedSurface, Part
from worker.models.outline import Outline, outline_of
from worker.models.pictures import PictureSet
from worker.models.ply.body import read_body
from worker.models.ply.header import Header, read_header
from worker.models.ply.mesh import ELEMENTS, build_mesh


def read(data: bytes, files: Mapping[str, bytes]) -> Model:
    """Read a PLY of either kind.

    Raises:
        UnusableAssetError: `asset_unusable` or `asset_too_large`.
    """
    header = read_header(data)
    tables = read_body(data, header, ELEMENTS & {element.name for element in header.elements})
    mesh, warnings = build_mesh(header, tables)
    textured = _textured(header, files) if mesh.uv_sets else None
    if header.texture and textured is None:
        warnings.append("its comment names a picture that is not in its set")
    part = Part(mesh=mesh, matrix=np.eye(4), node=None, material=0 if textured else None, key="0")
    return Model(
        parts=(part,),
        node_names=(),
        surfaces=(textured[0],) if textured else (),
        cameras=(),
        lights=(),
        pictures=textured[1] if textured else {},
        warnings=tuple(warnings),
    )


def outline(data: bytes) -> Outline:
    """Measure a PLY.

    Raises:
        UnusableAssetError: As `read`.
    """
    header = read_header(data)
    model = read(data, {})
    names = {p.name for element in header.elements for p in element.properties}
    return outline_of(
        [model.parts[0].mesh],
        has_normals=names >= {"nx", "ny", "nz"},
        warnings=model.warnings,
    )


def _textured(
    header: Header, files: Mapping[str, bytes]
) -> tuple[NamedSurface, dict[str, bytes]] | None:
    """Make the surface that wears the picture of the comment, if it is in the set."""
    if header.texture not in files:
        return None
    pictures = PictureSet(files)
    picture = pictures.spec(header.texture, "colour")
    surface = PhongSpec(technique="phong", diffuse_color=ColorMap(texture=picture))
    return NamedSurface("", surface), pictures.used
