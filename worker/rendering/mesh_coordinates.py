"""Coordinates of vertices, as the shader chunks of the same names give those of fragments."""

import numpy as np

from api_schemas.coordinates.affine_uv import AffineUvSpec
from api_schemas.coordinates.cylindrical import CylindricalSpec
from api_schemas.coordinates.normal import NormalSpec
from api_schemas.coordinates.position import PositionSpec
from api_schemas.coordinates.uv import UvSpec
from api_schemas.families import CoordinatesSpec, LayoutSpec
from api_schemas.relief_use import suits_vertices
from worker import layouts
from worker.errors import RenderError
from worker.geometry.mesh import Mesh
from worker.geometry.topology import Floats

_CENTRE = np.array([1.0, 0.0, 0.0])
"""The direction that stands for none."""


def coordinates_of(spec: CoordinatesSpec, layout: LayoutSpec | None, mesh: Mesh) -> Floats:
    """Return where on a texture each vertex looks: (n, 2) on a picture, or (n, 3) in space.

    Args:
        spec: Such as suit vertices.
        layout: How directions lie on a picture, if they are directions.
        mesh: In the object's frame, which is also that of positions and normals.

    Raises:
        RenderError: Only fragments have such coordinates (`coordinates_unsuited`), or the mesh has
            no texture coordinates (`coordinates_missing`).
    """
    if not suits_vertices(spec):
        message = f"{spec.technique} coordinates depend on the eye; vertices have none"
        raise RenderError(message, code="coordinates_unsuited")
    match spec:
        case UvSpec() | AffineUvSpec():
            if not mesh.uv_sets:
                message = "a displaced mesh needs texture coordinates"
                raise RenderError(message, code="coordinates_missing")
            return mesh.uv(spec.set)
        case PositionSpec():
            found: Floats = mesh.positions @ np.array(spec.matrix).T + spec.offset
        case NormalSpec():
            found = mesh.normals
        case CylindricalSpec():
            return _round(mesh.positions, spec)
        case _:
            raise AssertionError(spec.technique)
    if layout is None:
        return found
    somewhere = (found != 0).any(axis=1, keepdims=True)
    return layouts.place(layout, np.where(somewhere, found, _CENTRE))


def _round(positions: Floats, spec: CylindricalSpec) -> Floats:
    x, y, z = positions.T
    first, second, along = {"x": (y, z, x), "y": (x, -z, y), "z": (x, y, z)}[spec.axis]
    u = np.arctan2(second, first) / (2 * np.pi)
    v = np.clip((along - spec.base) / spec.height, 0.0, 1.0)
    return np.stack([u - np.floor(u), v], axis=1)
