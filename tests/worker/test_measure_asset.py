import io
import json
import struct
from pathlib import Path
from typing import Any

import numpy as np
import PIL.Image
import pytest

from api_schemas.assets import ASSET_FACTS
from worker import measure_asset
from worker.errors import AssetMissingError, UnusableAssetError

TRIANGLE = b"v 0 0 0\nv 2 0 0\nv 0 3 0\n"
UNKNOWN = "0" * 64


def silent(_fraction: float, _stage: str) -> None:
    pass


def measured(folder: Path, data: bytes, media_type: str = "") -> dict[str, Any]:
    """The facts of a file, after the published schema has accepted them."""
    stored = folder / UNKNOWN
    stored.write_bytes(data)
    request = {"path": str(stored), "media_type": media_type}
    facts = measure_asset.run(request, folder / "unused", silent)
    ASSET_FACTS.validate_python(facts | {"sha256": UNKNOWN, "bytes": len(data)})
    return facts


def png(width: int, height: int) -> bytes:
    file = io.BytesIO()
    noise = np.random.default_rng(1).integers(0, 256, (height, width, 3), np.uint8)
    PIL.Image.fromarray(noise).save(file, "png")
    return file.getvalue()


def glb(picture: bytes) -> bytes:
    """A triangle and a picture in one file."""
    corners = struct.pack("<9f6f", 0, 0, 0, 1, 0, 0, 0, 1, 0, *range(6))
    content = corners + picture + bytes(-len(picture) % 4)
    views = [
        {"buffer": 0, "byteLength": len(corners)},
        {"buffer": 0, "byteOffset": len(corners), "byteLength": len(picture)},
    ]
    position = {"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"}
    uv = {"bufferView": 0, "byteOffset": 36, "componentType": 5126, "count": 3, "type": "VEC2"}
    attributes = {"POSITION": 0, "TEXCOORD_0": 1}
    document = {
        "asset": {"version": "2.0"},
        "scene": 0,
        "scenes": [{"nodes": [0]}],
        "nodes": [{"mesh": 0, "name": "thing"}],
        "meshes": [{"primitives": [{"attributes": attributes, "material": 0}]}],
        "materials": [{"name": "skin", "pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}],
        "textures": [{"source": 0}],
        "images": [{"bufferView": 1, "mimeType": "image/png"}],
        "buffers": [{"byteLength": len(content)}],
        "bufferViews": views,
        "accessors": [position | {"min": [0, 0, 0], "max": [1, 1, 0]}, uv],
    }
    text = json.dumps(document).encode()
    text += b" " * (-len(text) % 4)
    chunks = struct.pack("<II", len(text), 0x4E4F534A) + text
    chunks += struct.pack("<II", len(content), 0x004E4942) + content
    return struct.pack("<4sII", b"glTF", 2, 12 + len(chunks)) + chunks


def test_warming_names_the_decoder_for_the_fingerprint() -> None:
    stages: list[str] = []

    warmed = measure_asset.warm(lambda _fraction, stage: stages.append(stage))

    assert warmed["fingerprint"].startswith("OpenImageIO 3.")
    assert stages == ["readers", "ready"]


def test_facts_of_a_picture_are_json(tmp_path: Path) -> None:
    stored = tmp_path / ("0" * 64)
    PIL.Image.fromarray(np.zeros((3, 5, 4), np.uint8)).save(stored, format="png")

    facts = measure_asset.run({"path": str(stored)}, tmp_path / "unused", silent)

    assert json.loads(json.dumps(facts)) == {
        "kind": "image",
        "width": 5,
        "height": 3,
        "channels": 4,
        "bits": 8,
        "float": False,
        "format": "png",
        "media_type": "image/png",
        "has_alpha": True,
    }
    assert not (tmp_path / "unused").exists()


def test_a_missing_file_and_a_text_are_refused_by_name(tmp_path: Path) -> None:
    with pytest.raises(AssetMissingError):
        measure_asset.run({"path": str(tmp_path / "nothing")}, tmp_path, silent)
    text = tmp_path / "letter.png"
    text.write_text("Dear technical artist")
    with pytest.raises(UnusableAssetError) as refusal:
        measure_asset.run({"path": str(text)}, tmp_path, silent)
    assert refusal.value.code == "asset_unsupported"


def test_an_obj_is_measured_by_itself_and_names_the_files_it_needs(tmp_path: Path) -> None:
    data = (
        b"mtllib ./a b.mtl c.mtl\n" + TRIANGLE + b"vt 0 0\nvn 0 0 1\no thing\nusemtl red\n"
        b"f 1/1/1 2/1/1 3/1/1\nl 1 2 3\nf 1 2\n"
    )

    assert measured(tmp_path, data) == {
        "kind": "model",
        "format": "obj",
        "media_type": "model/obj",
        "triangles": 1,
        "lines": 2,
        "points": 0,
        "vertices": 6,
        "draws": 2,
        "bounds_min": [0, 0, 0],
        "bounds_max": [2, 3, 0],
        "uv_sets": 1,
        "has_normals": True,
        "has_tangents": False,
        "has_vertex_colors": False,
        "materials": ["red"],
        "nodes": ["thing"],
        "cameras": [],
        "scenes": 0,
        "lights": 0,
        "texels": 0,
        "files": ["a b.mtl", "c.mtl"],
        "warnings": ["1 faces and lines of too few corners are left out"],
    }
    assert not (tmp_path / "unused").exists()


def test_ply_and_stl_are_told_by_their_content(tmp_path: Path) -> None:
    ply = (
        b"ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\n"
        b"property float z\nproperty float nx\nproperty float ny\nproperty float nz\n"
        b"property uchar red\nproperty uchar green\nproperty uchar blue\nend_header\n"
        b"1 2 3 0 0 1 255 0 0\n"
    )
    cloud = measured(tmp_path, ply, "model/stl")
    flat = measured(tmp_path, bytes(80) + b"\1\0\0\0" + bytes(50), "image/png")

    assert (cloud["format"], cloud["media_type"]) == ("ply", "model/ply")
    assert (cloud["points"], cloud["has_normals"], cloud["has_vertex_colors"]) == (1, True, True)
    assert (flat["format"], flat["triangles"], flat["vertices"]) == ("stl", 1, 3)
    assert not flat["has_normals"]


def test_a_material_library_names_its_materials_and_pictures(tmp_path: Path) -> None:
    facts = measured(tmp_path, b"# two\nnewmtl a\nmap_Kd x y.png\nnewmtl b\nmap_Kd .\\x y.png\n")

    assert facts == {
        "kind": "material_library",
        "format": "mtl",
        "media_type": "model/mtl",
        "materials": ["a", "b"],
        "files": ["x y.png"],
    }


def test_a_library_without_materials_is_one_if_it_is_called_so(tmp_path: Path) -> None:
    nothing = b"# Blender MTL File: 'None'\n# Material Count: 0\n"

    assert measured(tmp_path, nothing, "model/mtl")["materials"] == []
    with pytest.raises(UnusableAssetError) as refusal:
        measured(tmp_path, nothing)
    assert refusal.value.code == "asset_unsupported"
    with pytest.raises(UnusableAssetError, match="no text"):
        measured(tmp_path, b"\0\1\2", "model/mtl")


@pytest.mark.parametrize("data", [b"", b"\0", png(2, 2), TRIANGLE])
def test_a_buffer_is_whatever_is_called_so(tmp_path: Path, data: bytes) -> None:
    assert measured(tmp_path, data, "application/gltf-buffer") == {
        "kind": "buffer",
        "format": "bin",
        "media_type": "application/gltf-buffer",
    }


def test_pictures_inside_a_model_are_decoded_and_counted(tmp_path: Path) -> None:
    facts = measured(tmp_path, glb(png(30, 20)))

    assert (facts["format"], facts["triangles"], facts["texels"]) == ("glb", 1, 600)
    assert (facts["materials"], facts["nodes"]) == (["skin"], ["thing"])


def test_a_damaged_picture_inside_a_model_is_refused(tmp_path: Path) -> None:
    picture = bytearray(png(30, 20))
    picture[400:500] = bytes(100)  # within the compressed rows: the chunks stay as they are

    with pytest.raises(UnusableAssetError) as refusal:
        measured(tmp_path, glb(bytes(picture)))
    assert refusal.value.code == "asset_unusable"


def test_an_empty_file_is_refused_whatever_it_is_called(tmp_path: Path) -> None:
    for media_type in ("", "image/png", "model/obj", "model/mtl"):
        with pytest.raises(UnusableAssetError, match="empty"):
            measured(tmp_path, b"", media_type)


def test_a_path_out_of_the_folder_is_told_as_a_plain_name(tmp_path: Path) -> None:
    facts = measured(tmp_path, b"mtllib ../../../../etc/passwd\n" + TRIANGLE + b"f 1 2 3")

    assert facts["files"] == ["passwd"]
    with pytest.raises(UnusableAssetError, match="nothing is fetched"):
        measured(tmp_path, b"mtllib http://169.254.169.254/a.mtl\n" + TRIANGLE + b"f 1 2 3")


@pytest.mark.corpus
def test_every_model_of_the_corpus_has_facts_that_the_schema_accepts(
    corpus: Path, tmp_path: Path
) -> None:
    endings = (".obj", ".mtl", ".ply", ".stl", ".glb", ".gltf")
    paths = [p for p in (corpus / "1_models").rglob("*") if p.suffix.lower() in endings]

    assert len(paths) > 50
    for path in paths:
        facts = measured(tmp_path, path.read_bytes())
        expected = "material_library" if path.suffix == ".mtl" else "model"
        assert facts["kind"] == expected, path
        if expected == "model":
            assert facts["triangles"] + facts["lines"] + facts["points"] > 0, path
