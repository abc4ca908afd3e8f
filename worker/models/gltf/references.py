"""Whether everything that is referred to is there."""

from collections.abc import Iterator, Sized

from worker.models.gltf.document.root import Document
from worker.models.gltf.faults import unusable


def check_references(document: Document) -> None:
    """Check every index that is followed later.

    Raises:
        UnusableAssetError: One points to nothing.
    """
    for place, index, targets in _references(document):
        if index is not None and index >= len(targets):
            raise unusable(place, f"index {index} is not below {len(targets)}")


def _references(document: Document) -> Iterator[tuple[str, int | None, Sized]]:
    yield from _of_data(document)
    yield from _of_meshes(document)
    yield from _of_materials(document)
    yield from _of_nodes(document)


def _of_data(document: Document) -> Iterator[tuple[str, int | None, Sized]]:
    for i, view in enumerate(document.buffer_views):
        yield f"/bufferViews/{i}/buffer", view.buffer, document.buffers
    for i, accessor in enumerate(document.accessors):
        place = f"/accessors/{i}"
        yield f"{place}/bufferView", accessor.buffer_view, document.buffer_views
        if accessor.sparse is not None:
            indices, values = accessor.sparse.indices, accessor.sparse.values
            place += "/sparse"
            yield f"{place}/indices/bufferView", indices.buffer_view, document.buffer_views
            yield f"{place}/values/bufferView", values.buffer_view, document.buffer_views
    for i, image in enumerate(document.images):
        yield f"/images/{i}/bufferView", image.buffer_view, document.buffer_views


def _of_meshes(document: Document) -> Iterator[tuple[str, int | None, Sized]]:
    for i, mesh in enumerate(document.meshes):
        for j, primitive in enumerate(mesh.primitives):
            place = f"/meshes/{i}/primitives/{j}"
            yield f"{place}/indices", primitive.indices, document.accessors
            yield f"{place}/material", primitive.material, document.materials
            for accessor in primitive.attributes.values():
                yield f"{place}/attributes", accessor, document.accessors
            for k, target in enumerate(primitive.targets or ()):
                for accessor in target.values():
                    yield f"{place}/targets/{k}", accessor, document.accessors
    for i, skin in enumerate(document.skins):
        place = f"/skins/{i}"
        yield f"{place}/inverseBindMatrices", skin.inverse_bind_matrices, document.accessors
        yield f"{place}/skeleton", skin.skeleton, document.nodes
        for k, joint in enumerate(skin.joints):
            yield f"{place}/joints/{k}", joint, document.nodes


def _of_materials(document: Document) -> Iterator[tuple[str, int | None, Sized]]:
    for i, texture in enumerate(document.textures):
        yield f"/textures/{i}/sampler", texture.sampler, document.samplers
        yield f"/textures/{i}/source", texture.source, document.images
    for i, material in enumerate(document.materials):
        for place, info in material.textures():
            yield f"/materials/{i}{place}/index", info.index, document.textures


def _of_nodes(document: Document) -> Iterator[tuple[str, int | None, Sized]]:
    lights = document.extensions.lights.lights if document.extensions.lights else ()
    for i, node in enumerate(document.nodes):
        place = f"/nodes/{i}"
        yield f"{place}/camera", node.camera, document.cameras
        yield f"{place}/mesh", node.mesh, document.meshes
        yield f"{place}/skin", node.skin, document.skins
        if node.extensions.light is not None:
            yield f"{place}/extensions/KHR_lights_punctual", node.extensions.light.light, lights
        for k, child in enumerate(node.children or ()):
            yield f"{place}/children/{k}", child, document.nodes
    for i, scene in enumerate(document.scenes):
        for k, root in enumerate(scene.nodes or ()):
            yield f"/scenes/{i}/nodes/{k}", root, document.nodes
