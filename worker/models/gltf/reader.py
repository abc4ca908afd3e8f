"""glTF 2.0 to a model: the steps, in the order in which a file is believed."""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from api_schemas.lights import LIGHTS_MAX, Light
from worker.geometry.mesh import Mesh
from worker.models.gltf.accessors import Accessors
from worker.models.gltf.budget import Budget
from worker.models.gltf.cameras import camera_at
from worker.models.gltf.container import Container, open_container
from worker.models.gltf.document.materials import Material
from worker.models.gltf.document.root import Document, read_document
from worker.models.gltf.extensions import check_extensions
from worker.models.gltf.faults import unusable
from worker.models.gltf.json_text import parse
from worker.models.gltf.lights import light_at
from worker.models.gltf.materials import surface_of
from worker.models.gltf.mesh_checks import check_meshes
from worker.models.gltf.references import check_references
from worker.models.gltf.resources import Resources
from worker.models.gltf.shapes import Pose, shape
from worker.models.gltf.skinning import joint_matrices
from worker.models.gltf.storage import check_storage
from worker.models.gltf.textures import Textures
from worker.models.gltf.tree import Tree, check_nodes, grow, shown_nodes
from worker.models.limits import FARTHEST, WARNINGS_MAX
from worker.models.model import Model, NamedCamera, NamedSurface, Part


@dataclass(frozen=True, slots=True)
class Checked:
    """A document that keeps its word as far as JSON can: nothing outside it was looked at."""

    container: Container
    document: Document
    tree: Tree
    warnings: tuple[str, ...]


def read(data: bytes, files: Mapping[str, bytes], scene: int | None = None) -> Model:
    """Read a GLB or a .gltf at rest: morph targets at their default weights, skins unmoved.

    Args:
        data: The file.
        files: Buffers and pictures beside it, by name; nothing else is ever looked at.
        scene: Which of its scenes; its default one without.

    Raises:
        AssetMissingError: A file it speaks of is not in `files` (`asset_file_missing`).
        RenderError: It has no such scene (`model_part_unknown`).
        UnusableAssetError: `asset_unusable`, `asset_unsupported` or `asset_too_large`, with the
            place in the document.
    """
    return complete(check(data), files, scene)


def complete(checked: Checked, files: Mapping[str, bytes], scene: int | None = None) -> Model:
    """Read the data of a file whose JSON has been checked; see `read`."""
    document = checked.document
    shown = shown_nodes(document, checked.tree, scene)
    poses = resting_poses(document, shown)
    found = Resources.find(document, checked.container.binary, files)
    warnings = [*checked.warnings, *found.warnings]
    accessors = Accessors(document, found.buffers)
    textures = Textures(document, found.pictures, warnings)
    surfaces = [
        NamedSurface(material.name, surface_of(material, textures, f"/materials/{index}"))
        for index, material in enumerate(document.materials)
    ]
    parts = _parts(checked, accessors, shown, poses, warnings)
    if any(part.material == len(surfaces) for part in parts):
        surfaces.append(NamedSurface("", surface_of(Material(), textures, "/materials")))
    cameras, lights = views(checked, shown, warnings)
    return Model(
        parts=tuple(parts),
        node_names=tuple(node.name for node in document.nodes),
        surfaces=tuple(surfaces),
        cameras=tuple(cameras),
        lights=tuple(lights),
        pictures={p.sha256: p.content for p in found.pictures if p is not None},
        warnings=tuple(dict.fromkeys(warnings))[:WARNINGS_MAX],
    )


def check(data: bytes) -> Checked:
    """Parse a file and check everything that needs no data but the JSON.

    Raises:
        UnusableAssetError: See `read`.
    """
    container = open_container(data)
    value = parse(container.text)
    document = read_document(value)
    check_references(document)
    warnings = check_extensions(document, value)
    check_nodes(document)
    tree = grow(document)
    check_storage(document)
    check_meshes(document)
    if document.asset.version != "2.0":
        warnings.append("it is made for a later glTF than 2.0")
    if document.animations:
        warnings.append("animations are not played: the model is shown at rest")
    return Checked(container, document, tree, (*container.warnings, *warnings))


def resting_poses(document: Document, shown: list[int]) -> dict[int, tuple[float, ...]]:
    """Return the morph weights at each node with a mesh, after counting what they will cost."""
    budget = Budget(document)
    poses: dict[int, tuple[float, ...]] = {}
    held = set()
    for index in shown:
        node = document.nodes[index]
        if node.mesh is None:
            continue
        mesh = document.meshes[node.mesh]
        poses[index] = tuple(node.weights or mesh.weights or ())
        budget.draw(mesh.primitives)
        pose = (node.mesh, poses[index], index if node.skin is not None else None)
        if pose not in held:
            held.add(pose)
            budget.hold(mesh.primitives, poses[index])
    return poses


def _parts(
    checked: Checked,
    accessors: Accessors,
    shown: list[int],
    poses: dict[int, tuple[float, ...]],
    warnings: list[str],
) -> list[Part]:
    document, model_from_node = checked.document, checked.tree.model_from_node
    parts = []
    shapes: dict[str, Mesh | None] = {}
    numbers: dict[tuple[float, ...], int] = {}
    for index in shown:
        if index not in poses:
            continue
        node, matrix = document.nodes[index], model_from_node[index]
        mesh_index = node.mesh or 0
        joints = None
        variant = f"pose {numbers.setdefault(poses[index], len(numbers))}"
        if node.skin is not None:
            place = f"/skins/{node.skin}"
            joints = joint_matrices(document.skins[node.skin], model_from_node, accessors, place)
            matrix, variant = np.eye(4), f"node {index}"
        for k, primitive in enumerate(document.meshes[mesh_index].primitives):
            place = f"/meshes/{mesh_index}/primitives/{k}"
            key = f"{place} {variant}"
            if key not in shapes:
                pose = Pose(poses[index], joints)
                shapes[key] = shape(document, accessors, primitive, pose, place, warnings)
            mesh = shapes[key]
            if mesh is None:
                continue
            _check_reach(mesh, matrix, f"/nodes/{index}")
            material = len(document.materials)
            if primitive.material is not None:
                material = primitive.material
            parts.append(Part(mesh, matrix, index, material, key))
    return parts


def _check_reach(mesh: Mesh, matrix: np.ndarray, place: str) -> None:
    if any(max(uv.max(), -uv.min()) > FARTHEST for uv in mesh.uv_sets):
        raise unusable(place, f"its mesh has texture coordinates beyond {FARTHEST:g}")
    # The largest coordinate of any axis is found much faster than that of each, and does mostly.
    reach = np.full(3, max(mesh.positions.max(), -mesh.positions.min()))
    if not _is_near(matrix, reach) and not _is_near(matrix, np.abs(mesh.positions).max(axis=0)):
        raise unusable(place, f"its mesh reaches beyond {FARTHEST:g}")


def _is_near(matrix: np.ndarray, reach: np.ndarray) -> bool:
    return bool((np.abs(matrix[:3, :3]) @ reach + np.abs(matrix[:3, 3]) <= FARTHEST).all())


def views(
    checked: Checked, shown: list[int], warnings: list[str]
) -> tuple[list[NamedCamera], list[Light]]:
    """Place the cameras and lights of the nodes that are shown."""
    document = checked.document
    brought = document.extensions.lights.lights if document.extensions.lights else []
    cameras: list[NamedCamera] = []
    lights: list[Light] = []
    for index in shown:
        node, matrix = document.nodes[index], checked.tree.model_from_node[index]
        if node.camera is not None:
            camera = camera_at(document.cameras[node.camera], node, matrix)
            if isinstance(camera, str):
                warnings.append(camera)
            else:
                cameras.append(camera)
        if node.extensions.light is not None:
            light = light_at(brought[node.extensions.light.light], matrix)
            if isinstance(light, str):
                warnings.append(light)
            else:
                lights.append(light)
    if any(light.range is not None for light in brought):
        warnings.append("the range of lights is ignored: they reach everywhere")
    if len(lights) > LIGHTS_MAX:
        warnings.append(f"only the first {LIGHTS_MAX} lights shine")
    return cameras, lights[:LIGHTS_MAX]
