"""Whether reliefs fit the meshes they are on, told from facts: sizes, and texture coordinates."""

from collections.abc import Iterator, Mapping

from api_schemas.assets import AssetFacts, ModelFacts
from api_schemas.base import Schema
from api_schemas.coordinates.affine_uv import AffineUvSpec
from api_schemas.coordinates.cylindrical import CylindricalSpec
from api_schemas.coordinates.normal import NormalSpec
from api_schemas.coordinates.position import PositionSpec
from api_schemas.coordinates.uv import UvSpec
from api_schemas.families import CoordinatesSpec
from api_schemas.model_mesh import ModelMesh
from api_schemas.obstacle import Obstacle
from api_schemas.relief import DISPLACED_TRIANGLES_MAX, Displacement
from api_schemas.requests import Request
from api_schemas.scene import Node
from api_schemas.surface_spec import SurfaceSpec
from api_schemas.walk import parts

VertexCoordinates = UvSpec | AffineUvSpec | PositionSpec | NormalSpec | CylindricalSpec
"""Coordinates that a vertex has by itself, whoever looks at it; in its own frame, if in any."""


def relief_misuses(request: Request, facts: Mapping[str, AssetFacts]) -> Iterator[Obstacle]:
    """Yield what stands in the way of reliefs; models without facts are passed over."""
    for pointer, part in parts(request):
        if isinstance(part, Displacement) and not suits_vertices(part.coordinates):
            message = "vertices have no such coordinates; in their own frame they may have some"
            yield Obstacle("coordinates_unsuited", f"{pointer}/coordinates", message)
        if not isinstance(part, Node) or part.mesh is None:
            continue
        if isinstance(part.mesh, ModelMesh):
            model = facts.get(part.mesh.asset)
            if not isinstance(model, ModelFacts):
                continue
            yield from _too_fine(part, model.triangles, pointer)
            if model.uv_sets == 0:
                yield from _without_coordinates(part, pointer)
        else:
            yield from _too_fine(part, part.mesh.triangles, pointer)


def suits_vertices(coordinates: CoordinatesSpec) -> bool:
    """Whether vertices can be displaced by a relief that is looked up so."""
    own = getattr(coordinates, "frame", "object") == "object"
    return own and isinstance(coordinates, VertexCoordinates)


def _too_fine(node: Node, triangles: int, pointer: str) -> Iterator[Obstacle]:
    if node.displacement is None:
        return
    count = node.displacement.triangles(triangles)
    if count > DISPLACED_TRIANGLES_MAX:
        name = "" if node.displacement.subdivisions is None else "/subdivisions"
        message = f"{count} triangles after subdivision; at most {DISPLACED_TRIANGLES_MAX}"
        yield Obstacle("over_budget", f"{pointer}/displacement{name}", message)


def _without_coordinates(node: Node, pointer: str) -> Iterator[Obstacle]:
    displacement = node.displacement
    if displacement and isinstance(displacement.coordinates, UvSpec | AffineUvSpec):
        message = "the model has no texture coordinates to read a relief by"
        yield Obstacle("coordinates_missing", f"{pointer}/displacement/coordinates", message)
    for inner, surface in _worn(node):
        for name in ("normal", "bump"):
            mapped = getattr(surface, name)
            if mapped is None or (name == "normal" and mapped.space == "object"):
                continue
            message = "the model has no texture coordinates, so nothing says where u and v grow"
            yield Obstacle("coordinates_missing", f"{pointer}{inner}/{name}", message)


def _worn(node: Node) -> Iterator[tuple[str, Schema]]:
    for name in ("mesh", "surface", "surface_map"):
        for inner, found in parts(getattr(node, name), f"/{name}"):
            if isinstance(found, SurfaceSpec):
                yield inner, found
