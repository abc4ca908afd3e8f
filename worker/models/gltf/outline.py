"""What a glTF file tells of itself: by its content where it has it, else by its JSON alone."""

from collections.abc import Iterator
from itertools import product

import numpy as np

from worker.geometry.mesh import UV_SETS_MAX
from worker.models.gltf.document.meshes import Primitive
from worker.models.gltf.document.root import Document
from worker.models.gltf.reader import Checked, check, complete, resting_poses, views
from worker.models.gltf.resources import Resources, needed_files
from worker.models.gltf.semantics import sets_of
from worker.models.gltf.topology import KINDS, count_of
from worker.models.gltf.tree import shown_nodes
from worker.models.model import Model
from worker.models.outline import Corner, Outline


def outline(data: bytes) -> Outline:
    """Measure the default scene without the files beside the asset.

    Nothing is left to check where there are none. Else numbers of elements are what the JSON claims
    and bounds those of its own min and max.

    Raises:
        UnusableAssetError: `asset_unusable`, `asset_unsupported` or `asset_too_large`.
    """
    checked = check(data)
    files = needed_files(checked.document)
    if files:
        return _by_json(checked, files)
    return _by_content(checked, complete(checked, {}))


def _by_content(checked: Checked, model: Model) -> Outline:
    drawn = {"triangles": 0, "lines": 0, "points": 0}
    corners = []
    for part in model.parts:
        drawn[part.mesh.kind] += len(part.mesh.triangles)
        placed = part.mesh.positions @ part.matrix[:3, :3].T + part.matrix[:3, 3]
        corners += [placed.min(axis=0), placed.max(axis=0)]
    primitives = [primitive for _, primitive in _drawn(checked)]
    return Outline(
        triangles=drawn["triangles"],
        lines=drawn["lines"],
        points=drawn["points"],
        vertices=sum(len(part.mesh.positions) for part in model.parts),
        draws=len(model.parts),
        bounds=_box(corners),
        uv_sets=max((len(part.mesh.uv_sets) for part in model.parts), default=0),
        has_normals=_brings(primitives, "NORMAL"),
        has_tangents=_brings(primitives, "TANGENT"),
        has_vertex_colours=_brings(primitives, "COLOR_0"),
        materials=tuple(surface.name for surface in model.surfaces),
        nodes=model.node_names,
        cameras=tuple(camera.name for camera in model.cameras),
        scenes=len(checked.document.scenes),
        lights=len(model.lights),
        pictures=tuple(model.pictures.values()),
        warnings=model.warnings,
    )


def _by_json(checked: Checked, files: tuple[str, ...]) -> Outline:
    document = checked.document
    shown = shown_nodes(document, checked.tree, None)
    resting_poses(document, shown)
    found = Resources.find(document, checked.container.binary, None)
    warnings = [*checked.warnings, *found.warnings]
    cameras, lights = views(checked, shown, warnings)
    drawn = {"triangles": 0, "lines": 0, "points": 0}
    vertices = 0
    corners = []
    primitives = []
    for node, primitive in _drawn(checked):
        primitives.append(primitive)
        count = document.accessors[primitive.attributes["POSITION"]].count
        length = count if primitive.indices is None else document.accessors[primitive.indices].count
        elements, kind = count_of(primitive.mode, length), KINDS[primitive.mode]
        drawn[kind] += elements
        is_split = kind == "triangles" and "NORMAL" not in primitive.attributes
        vertices += 3 * elements if is_split else min(count, length)
        corners += _corners(document, primitive, checked.tree.model_from_node[node])
    unnamed = ("",) if any(primitive.material is None for primitive in primitives) else ()
    sets = (len(sets_of(list(primitive.attributes), "TEXCOORD")) for primitive in primitives)
    return Outline(
        triangles=drawn["triangles"],
        lines=drawn["lines"],
        points=drawn["points"],
        vertices=vertices,
        draws=len(primitives),
        bounds=_box(corners),
        uv_sets=min(max(sets, default=0), UV_SETS_MAX),
        has_normals=_brings(primitives, "NORMAL"),
        has_tangents=_brings(primitives, "TANGENT"),
        has_vertex_colours=_brings(primitives, "COLOR_0"),
        materials=tuple(material.name for material in document.materials) + unnamed,
        nodes=tuple(node.name for node in document.nodes),
        cameras=tuple(camera.name for camera in cameras),
        scenes=len(document.scenes),
        lights=len(lights),
        pictures=tuple({p.sha256: p.content for p in found.pictures if p is not None}.values()),
        files=files,
        warnings=tuple(dict.fromkeys(warnings)),
    )


def _drawn(checked: Checked) -> Iterator[tuple[int, Primitive]]:
    """Yield what the default scene draws, with the node that carries it."""
    document = checked.document
    for index in shown_nodes(document, checked.tree, None):
        mesh = document.nodes[index].mesh
        if mesh is not None:
            for primitive in document.meshes[mesh].primitives:
                if "POSITION" in primitive.attributes:
                    yield index, primitive


def _corners(document: Document, primitive: Primitive, matrix: np.ndarray) -> list[np.ndarray]:
    """Return the corners of the box that the file itself gives for a mesh, where it stands."""
    accessor = document.accessors[primitive.attributes["POSITION"]]
    if accessor.min is None or accessor.max is None or accessor.normalized:
        return []
    corners = np.array(list(product(*zip(accessor.min, accessor.max, strict=True))))
    return list(corners @ matrix[:3, :3].T + matrix[:3, 3])


def _box(corners: list[np.ndarray]) -> tuple[Corner, Corner] | None:
    if not corners:
        return None
    lowest, highest = np.min(corners, axis=0).tolist(), np.max(corners, axis=0).tolist()
    return tuple(lowest), tuple(highest)


def _brings(primitives: list[Primitive], name: str) -> bool:
    return any(name in primitive.attributes for primitive in primitives)
