"""Whether reliefs fit the meshes they are on, told from facts: sizes, and texture coordinates."""

from collections.abc import Iterator, Mapping

from api_schemas.assets import AssetFacts, ModelFacts
from api_schemas.base import Schema
from api_schemas.coordinates.affine_uv import AffineUvSpec
from api_schemas.coordinates.uv import UvSpec
from api_schemas.families import SurfaceSpec
from api_schemas.model_mesh import ModelMesh
from api_schemas.obstacle import Obstacle
from api_schemas.relief import DISPLACED_TRIANGLES_MAX
from api_schemas.requests import Request
from api_schemas.scene import Node
from api_schemas.walk import parts


def relief_misuses(request: Request, facts: Mapping[str, AssetFacts]) -> Iterator[Obstacle]:
    """Yield what stands in the way of reliefs; models without facts are passed over."""
    for pointer, part in parts(request):
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
