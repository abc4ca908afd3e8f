"""What an uploaded model, or a file beside one, is: told by its content."""

from typing import Any, Final

from worker.errors import UnusableAssetError
from worker.models.formats import ModelFormat, model_format, outline
from worker.models.limits import WARNINGS_MAX
from worker.models.obj import mtl
from worker.models.pictures import measure

BUFFER_TYPE: Final = "application/gltf-buffer"
LIBRARY_TYPE: Final = "model/mtl"
MEDIA_TYPES: Final[dict[ModelFormat, str]] = {
    "glb": "model/gltf-binary",
    "gltf": "model/gltf+json",
    "obj": "model/obj",
    "ply": "model/ply",
    "stl": "model/stl",
}
_NAME_LENGTH_MAX = 256


def measure_model(data: bytes, media_type: str) -> dict[str, Any] | None:
    """Read a model or a material library by itself, and say what is in it.

    Args:
        data: The file.
        media_type: What its uploader calls it: a library without materials looks like any text.

    Returns:
        JSON-able facts, or None if it is neither.

    Raises:
        UnusableAssetError: `asset_unusable`, `asset_unsupported` or `asset_too_large`.
    """
    form = model_format(data)
    if form is not None:
        return _model_facts(data, form)
    if media_type == LIBRARY_TYPE or mtl.is_mtl(data):
        return _library_facts(data)
    return None


def buffer_facts() -> dict[str, Any]:
    """Give the facts of a glTF buffer, in which any bytes are right."""
    return {"kind": "buffer", "format": "bin", "media_type": BUFFER_TYPE}


def _model_facts(data: bytes, form: ModelFormat) -> dict[str, Any]:
    found = outline(data, form)
    lowest, highest = found.bounds or (None, None)
    pictures = [measure(picture) for picture in found.pictures]
    return {
        "kind": "model",
        "format": form,
        "media_type": MEDIA_TYPES[form],
        "triangles": found.triangles,
        "lines": found.lines,
        "points": found.points,
        "vertices": found.vertices,
        "draws": found.draws,
        "bounds_min": None if lowest is None else list(lowest),
        "bounds_max": None if highest is None else list(highest),
        "uv_sets": found.uv_sets,
        "has_normals": found.has_normals,
        "has_tangents": found.has_tangents,
        "has_vertex_colors": found.has_vertex_colours,
        "materials": _names(found.materials),
        "nodes": _names(found.nodes),
        "cameras": _names(found.cameras),
        "scenes": found.scenes,
        "lights": found.lights,
        "texels": sum(picture["width"] * picture["height"] for picture in pictures),
        "files": list(found.files),
        "warnings": _names(found.warnings[:WARNINGS_MAX]),
    }


def _library_facts(data: bytes) -> dict[str, Any]:
    if b"\0" in data:
        raise UnusableAssetError("the material library is no text")
    materials = mtl.parse(data)
    return {
        "kind": "material_library",
        "format": "mtl",
        "media_type": LIBRARY_TYPE,
        "materials": [material.name for material in materials],
        "files": list(mtl.needed(materials)),
    }


def _names(names: tuple[str, ...]) -> list[str]:
    return [name[:_NAME_LENGTH_MAX] for name in names]
