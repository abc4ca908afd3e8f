"""Whether every primitive is one that glTF allows, told from the JSON alone."""

from worker.geometry.mesh import UV_SETS_MAX
from worker.models.gltf.document.meshes import Primitive
from worker.models.gltf.document.root import Document
from worker.models.gltf.extensions import QUANTIZATION
from worker.models.gltf.faults import spoken, unsupported, unusable
from worker.models.gltf.limits import JOINT_SETS_MAX
from worker.models.gltf.semantics import (
    ATTRIBUTES,
    INDICES,
    INVERSE_BIND_MATRICES,
    TARGETS,
    Format,
    kind_of,
    sets_of,
)

_MODES = range(7)


def check_meshes(document: Document) -> None:
    """Check names, formats and numbers of attributes, and what materials need of them.

    Raises:
        UnusableAssetError: glTF forbids it (`asset_unusable`), or it is not done here
            (`asset_unsupported`).
    """
    for i, mesh in enumerate(document.meshes):
        for j, primitive in enumerate(mesh.primitives):
            place = f"/meshes/{i}/primitives/{j}"
            _check_attributes(document, primitive, place)
            _check_indices(document, primitive, place)
            _check_targets(document, primitive, place)
            _check_material(document, primitive, place)
    for i, skin in enumerate(document.skins):
        if skin.inverse_bind_matrices is not None:
            place = f"/skins/{i}/inverseBindMatrices"
            _check_format(document, skin.inverse_bind_matrices, INVERSE_BIND_MATRICES, place)
            if document.accessors[skin.inverse_bind_matrices].count < len(skin.joints):
                raise unusable(place, "there are fewer matrices than joints")


def _check_attributes(document: Document, primitive: Primitive, place: str) -> None:
    place = f"{place}/attributes"
    for name, accessor in primitive.attributes.items():
        if name.startswith("_"):
            continue
        kind = kind_of(name)
        if kind is None:
            raise unusable(place, f"glTF has no attribute {spoken(name)}")
        _check_format(document, accessor, ATTRIBUTES[kind[0]], f"{place}/{name}")
    if len({document.accessors[index].count for index in primitive.attributes.values()}) > 1:
        raise unusable(place, "the attributes have different numbers of elements")
    names = list(primitive.attributes)
    for kind_name in ("TEXCOORD", "COLOR", "JOINTS", "WEIGHTS"):
        sets = sets_of(names, kind_name)
        if sets != list(range(len(sets))):
            raise unusable(place, f"the sets of {kind_name} are not numbered from 0")
    joints, weights = sets_of(names, "JOINTS"), sets_of(names, "WEIGHTS")
    if joints != weights:
        raise unusable(place, "there are not as many sets of JOINTS as of WEIGHTS")
    if len(joints) > JOINT_SETS_MAX:
        raise unsupported(place, f"more than {4 * JOINT_SETS_MAX} joints move a vertex")


def _check_indices(document: Document, primitive: Primitive, place: str) -> None:
    if primitive.mode not in _MODES:
        raise unusable(f"{place}/mode", "it is none of 0..6")
    if primitive.indices is None:
        return
    place = f"{place}/indices"
    _check_format(document, primitive.indices, INDICES, place)
    view = document.accessors[primitive.indices].buffer_view
    if view is not None and document.buffer_views[view].byte_stride is not None:
        raise unusable(place, "the view of indices has a byteStride")


def _check_targets(document: Document, primitive: Primitive, place: str) -> None:
    for k, target in enumerate(primitive.targets or ()):
        here = f"{place}/targets/{k}"
        for name, accessor in target.items():
            if name.startswith("_"):
                continue
            kind = kind_of(name)
            if kind is None or kind[0] not in TARGETS:
                raise unusable(here, f"no target can move {spoken(name)}")
            if name not in primitive.attributes:
                raise unusable(here, f"there is no {name} to be moved")
            _check_format(document, accessor, TARGETS[kind[0]], f"{here}/{name}")
            base = document.accessors[primitive.attributes[name]].count
            if document.accessors[accessor].count != base:
                raise unusable(here, "it has another number of elements than what it moves")


def _check_material(document: Document, primitive: Primitive, place: str) -> None:
    if primitive.material is None:
        return
    present = len(sets_of(list(primitive.attributes), "TEXCOORD"))
    for where, info in document.materials[primitive.material].textures():
        if info.uv_set >= present:
            raise unusable(f"{place}/material", f"{where[1:]} needs TEXCOORD_{info.uv_set}")
        if info.uv_set >= UV_SETS_MAX:
            raise unsupported(
                f"{place}/material", f"only TEXCOORD_0 to TEXCOORD_{UV_SETS_MAX - 1} are read"
            )


def _check_format(document: Document, accessor: int, form: Format, place: str) -> None:
    quantization = QUANTIZATION in document.extensions_used
    if not form.fits(document.accessors[accessor], quantization=quantization):
        raise unusable(place, f"accessor {accessor} has a format that this cannot have")
