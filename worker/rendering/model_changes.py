"""What a request changes of a model: other surfaces, hidden nodes."""

from collections.abc import Iterator, Sequence

from api_schemas.model_mesh import ModelMesh
from api_schemas.surface_spec import SurfaceSpec
from worker.errors import RenderError
from worker.models.model import Model, Part


def seen_parts(mesh: ModelMesh, model: Model) -> Iterator[tuple[Part, SurfaceSpec | None]]:
    """Yield the parts of a model that are seen, each with its surface, if it has one.

    A changed node wins over a changed material. A name addresses all that bear it; the last change
    of the same thing counts.

    Raises:
        RenderError: The model has no such node or material (`model_part_unknown`).
    """
    surfaces = {index: named.surface for index, named in enumerate(model.surfaces)}
    material_names = [named.name for named in model.surfaces]
    for place, material in enumerate(mesh.materials):
        for index in _indices(material.material, material_names, f"materials/{place}/material"):
            surfaces[index] = material.surface
    worn: dict[int, SurfaceSpec] = {}
    hidden: set[int] = set()
    for place, node in enumerate(mesh.nodes):
        for index in _indices(node.node, model.node_names, f"nodes/{place}/node"):
            hidden.discard(index)
            if not node.visible:
                hidden.add(index)
            if node.surface is not None:
                worn[index] = node.surface
    for part in model.parts:
        if part.node is not None and part.node in hidden:
            continue
        own = surfaces[part.material] if part.material is not None else None
        yield part, worn.get(part.node, own) if part.node is not None else own


def _indices(wanted: str | int, names: Sequence[str], place: str) -> list[int]:
    if isinstance(wanted, int):
        found = [wanted] if wanted < len(names) else []
    else:
        found = [index for index, name in enumerate(names) if name == wanted]
    if not found:
        message = f"the model has no such part at {place}"
        raise RenderError(message, code="model_part_unknown")
    return found
