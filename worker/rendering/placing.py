"""From a request's nodes to meshes that stand somewhere in the world, each with its surface."""

import functools
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from functools import partial
from typing import Protocol

import numpy as np

from api_schemas.model_mesh import ModelMesh
from api_schemas.relief import Displacement
from api_schemas.scene import Node
from api_schemas.surface_spec import SurfaceSpec
from api_schemas.surfaces.phong import PhongSpec
from worker.geometry import primitives
from worker.geometry.mesh import Mesh
from worker.geometry.transforms import Matrix, parent_from_node
from worker.models.model import Model, Part
from worker.rendering.displacing import levels_of, relief_of, with_relief
from worker.rendering.model_changes import seen_parts
from worker.rendering.shading import Selection
from worker.rendering.staging import PlacedModel
from worker.rendering.texture_maker import TextureMaker

_MATT_GREY = PhongSpec(technique="phong")


class ModelReader(Protocol):
    """Reads uploaded models."""

    def __call__(self, mesh: ModelMesh, /) -> Model:
        """Return the model."""


@dataclass(frozen=True, slots=True)
class Placed:
    """A mesh that is kept or can be made, its surface, and where it stands.

    Attributes:
        key: Equal keys mean the same mesh.
        mesh: Makes it.
        surface: What it wears.
        world_from_object: Where it stands.
        node: Which node of the request it is, or is a part of.
        name: What people call it.
        thing: Its number, from 1.
        selection: Where the surface is, if not everywhere.
    """

    key: str
    mesh: Callable[[], Mesh]
    surface: SurfaceSpec
    world_from_object: Matrix
    node: Node
    name: str
    thing: int = 0
    selection: Selection | None = None

    @property
    def worn(self) -> str:
        """What surfaces that share a program and its parameters have in common."""
        surface = self.surface.model_dump_json()
        if self.selection is None:
            return surface
        return f"{surface} {self.selection.number} {self.selection.among.model_dump_json()}"


def place(
    nodes: list[Node], maker: TextureMaker, reader: ModelReader
) -> tuple[list[Placed], list[PlacedModel]]:
    """Return what is drawn, in the order of the request, and the models it is from.

    Args:
        nodes: The scene's.
        maker: Makes the pictures of reliefs.
        reader: Reads the uploaded models.

    Raises:
        WorkerError: A model cannot be read or has no such part, or a relief would have too many
            triangles.
    """
    placed: list[Placed] = []
    models: list[PlacedModel] = []
    things = 0
    for node, matrix in _nodes(nodes, np.eye(4)):
        if isinstance(node.mesh, ModelMesh):
            model = reader(node.mesh)
            models.append(PlacedModel(model, matrix))
            found = list(_parts(node, node.mesh, model, matrix))
            triangles = model.triangles
        elif node.mesh is not None:
            key = node.mesh.model_dump_json()
            make = partial(primitives.build, node.mesh)
            found = [Placed(key, make, node.surface or _MATT_GREY, matrix, node, node.name or "")]
            triangles = node.mesh.triangles
        else:
            continue
        if node.displacement is not None:
            found = list(_displaced(found, node.displacement, triangles, maker))
        for item in found:
            things += 1
            name = item.name or f"{node.mesh.type} {things}"
            placed += _selected(replace(item, thing=things, name=name))
    return placed, models


def _nodes(nodes: list[Node], world_from_parent: Matrix) -> Iterator[tuple[Node, Matrix]]:
    for node in nodes:
        matrix = world_from_parent @ parent_from_node(node.transform)
        yield node, matrix
        yield from _nodes(node.children, matrix)


def _selected(item: Placed) -> list[Placed]:
    """Return a thing once for each of its surfaces."""
    among = item.node.surface_map
    if among is None:
        return [item]
    return [
        replace(item, surface=surface, selection=Selection(among, number))
        for number, surface in enumerate(among.surfaces)
    ]


def _parts(node: Node, mesh: ModelMesh, model: Model, matrix: Matrix) -> Iterator[Placed]:
    # Keys of parts are a model's own, and one file is another model for each set and scene.
    own = f"{mesh.asset} {sorted(mesh.files.items())} {mesh.scene}"
    for part, worn in seen_parts(mesh, model):
        yield Placed(
            key=f"{own} {part.key}",
            mesh=partial(_mesh_of, part),
            surface=node.surface or worn or _MATT_GREY,
            world_from_object=matrix @ part.matrix,
            node=node,
            name="/".join(name for name in (node.name, _name_of(part, model)) if name),
        )


def _displaced(
    items: list[Placed], spec: Displacement, triangles: int, maker: TextureMaker
) -> Iterator[Placed]:
    levels = levels_of(spec, triangles)
    texture = functools.cache(lambda: relief_of(spec, maker))

    def moved(make: Callable[[], Mesh]) -> Mesh:
        return with_relief(make(), spec, levels, texture())

    for item in items:
        key = f"{item.key} {levels} {spec.model_dump_json()}"
        yield replace(item, key=key, mesh=partial(moved, item.mesh))


def _mesh_of(part: Part) -> Mesh:
    return part.mesh


def _name_of(part: Part, model: Model) -> str:
    return "" if part.node is None else model.node_names[part.node]
