"""Uploaded models of any format, told by their content."""

from collections.abc import Mapping
from typing import Literal

from worker.errors import UnusableAssetError
from worker.models.gltf import outline as gltf_outline
from worker.models.gltf import reader as gltf_reader
from worker.models.model import Model
from worker.models.obj import reader as obj
from worker.models.outline import Outline
from worker.models.ply import reader as ply
from worker.models.ply.header import is_ply
from worker.models.stl import reader as stl

ModelFormat = Literal["glb", "gltf", "obj", "ply", "stl"]
_NUL = b"\0"
_LOOKED_AT = 4096


def model_format(data: bytes) -> ModelFormat | None:
    """Tell the format of a model, or that it is none."""
    if data.startswith(b"glTF"):
        return "glb"
    if is_ply(data):
        return "ply"
    if stl.is_binary_stl(data):
        return "stl"
    if _NUL in data[:_LOOKED_AT]:
        return None
    if data[:_LOOKED_AT].removeprefix(b"\xef\xbb\xbf").lstrip().startswith(b"{"):
        return "gltf"
    if stl.is_text_stl(data):
        return "stl"
    return "obj" if obj.is_obj(data) else None


def outline(data: bytes, form: ModelFormat) -> Outline:
    """Measure a model of a format without the files beside it.

    Raises:
        UnusableAssetError: `asset_unsupported`, `asset_unusable` or `asset_too_large`.
    """
    match form:
        case "obj":
            return obj.outline(data)
        case "ply":
            return ply.outline(data)
        case "stl":
            return stl.outline(data)
        case "glb" | "gltf":
            return gltf_outline.outline(data)


def warm() -> None:
    """Compile every kernel of the readers, on the smallest files that reach them."""
    for data in _SMALL_FILES:
        read_model(data, {})


def read_model(data: bytes, files: Mapping[str, bytes], scene: int | None = None) -> Model:
    """Read a model.

    Args:
        data: The file.
        files: The files it speaks of, by name.
        scene: Which of its scenes; its default one without.

    Raises:
        UnusableAssetError: `asset_unsupported`, `asset_unusable` or `asset_too_large`.
        AssetMissingError: `asset_file_missing`: a file it speaks of is not among the files.
        RenderError: `model_part_unknown`: it has no such scene.
    """
    match model_format(data):
        case "obj":
            return obj.read(data, files)
        case "ply":
            return ply.read(data, files)
        case "stl":
            return stl.read(data)
        case None:
            raise UnusableAssetError(
                "it is none of glTF, GLB, OBJ, PLY and STL", code="asset_unsupported"
            )
        case "glb" | "gltf":
            return gltf_reader.read(data, files, scene)


_HOLLOW = b"v 0 0 0\nv 2 0 0\nv 2 2 0\nv 1 1 0\nf 1 2 3 4\ng a\nf -4/-4/-4 -3 -2\nl 1 2\np 1\n"
_TEXT_PLY = (
    b"ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
    b"property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
    b"0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"
)
_BINARY_PLY = (
    b"ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty uchar x\n"
    b"property uchar y\nproperty uchar z\nelement face 1\n"
    b"property list uchar uchar vertex_indices\nend_header\n"
    b"\0\0\0\1\0\0\0\1\0\3\0\1\2"
)
_TEXT_STL = (
    b"solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n"
    b"endloop\nendfacet\nendsolid\n"
)
_SMALL_FILES = (_HOLLOW, _TEXT_PLY, _BINARY_PLY, _TEXT_STL)
