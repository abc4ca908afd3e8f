import csv
import json
import time
from pathlib import Path

import numpy as np
import pytest

from tests.worker.models.refusals import outcome
from worker.errors import UnusableAssetError
from worker.models.formats import model_format, outline, read_model

TRIANGLE = b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"


@pytest.mark.parametrize(
    ("data", "expected"),
    [
        (b"glTF\x02\0\0\0", "glb"),
        (b' \n{"asset": {}}', "gltf"),
        (b"\xef\xbb\xbf{}", "gltf"),
        (b"ply\r\nformat", "ply"),
        (b"solid a\nfacet normal", "stl"),
        (b"solid a\nendsolid a", "stl"),
        (b"solid".ljust(80) + b"\1\0\0\0" + bytes(50), "stl"),
        (TRIANGLE, "obj"),
        (b"\xef\xbb\xbf" + TRIANGLE, "obj"),
        (b"", None),
        (b"Dear technical artist", None),
        (b"newmtl a\nKd 1 1 1", None),
        (b"solid ground\nv 0 0 0", None),
        (b"OFF\n3 1 0\n0 0 0", None),
        (b"\0" * 84, "stl"),
        (b"\0" * 83, None),
        (b"\0\n" + TRIANGLE, None),
        (b"PK\x03\x04" + bytes(500), None),
        (b"v 1 2 3\n" * 5, None),
    ],
)
def test_the_content_tells_the_format(data: bytes, expected: str | None) -> None:
    assert model_format(data) == expected


def test_any_other_file_is_not_supported() -> None:
    with pytest.raises(UnusableAssetError, match="none of glTF, GLB, OBJ, PLY and STL") as refusal:
        read_model(b"Dear technical artist", {})
    assert refusal.value.code == "asset_unsupported"


def facts(corpus: Path) -> dict[str, dict[str, str]]:
    """What trimesh found in the models of the corpus."""
    with (corpus / "1_models" / "FACTS.csv").open() as file:
        rows = {row["file"]: row for row in csv.DictReader(file)}
    return {n: row for n, row in rows.items() if n.lower().endswith((".obj", ".ply", ".stl"))}


@pytest.mark.corpus
def test_the_models_of_the_corpus_have_the_triangles_and_bounds_that_trimesh_finds(
    corpus: Path,
) -> None:
    known = facts(corpus)

    assert len(known) == 31
    for name, row in known.items():
        data = (corpus / "1_models" / name).read_bytes()
        found = outline(data, model_format(data))  # type: ignore[arg-type]
        bounds = [json.loads(row["bounds_min"]), json.loads(row["bounds_max"])]
        assert found.triangles == int(row["trimesh_triangles"]), name
        # The file of facts rounds to five decimals.
        np.testing.assert_allclose(found.bounds, bounds, atol=6e-6, err_msg=name)


@pytest.mark.corpus
def test_normals_of_the_corpus_are_unit_and_positions_are_numbers(corpus: Path) -> None:
    for name in facts(corpus):
        path = corpus / "1_models" / name
        files = {other.name: other.read_bytes() for other in path.parent.iterdir()}
        for part in read_model(path.read_bytes(), {"surface.mtl": b"", **files}).parts:
            lengths = np.linalg.norm(part.mesh.normals, axis=1)
            np.testing.assert_allclose(lengths, 1, atol=1e-12, err_msg=name)
            assert part.mesh.triangles.max() < len(part.mesh.positions)


@pytest.mark.corpus
@pytest.mark.parametrize(
    ("name", "expected"),
    [
        ("mesh_assimp/OutOfMemory.off", "asset_unsupported"),
        ("mesh_assimp/crash-30d6d0f7c529b3b66b4131700b7a4580cd7082df.ply", "asset_unusable"),
        ("mesh_assimp/empty.ply", "asset_unsupported"),
        ("mesh_assimp/malformed.obj", "asset_unusable"),
        ("mesh_trimesh/empty.ply", "asset_unusable"),
        ("mesh_trimesh/ply_empty_header.ply", "asset_unusable"),
        ("mesh_trimesh/busted.STL", "read"),
        ("mesh_trimesh/singlevn.obj", "read"),
    ],
)
def test_hostile_models_are_refused_by_name_or_read(corpus: Path, name: str, expected: str) -> None:
    data = (corpus / "4_hostile" / name).read_bytes()
    began = time.monotonic()

    assert outcome(data, {"surface.mtl": b""}) == expected
    assert time.monotonic() - began < 5
