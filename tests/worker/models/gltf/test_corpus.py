"""Files of others: what they hold, and what the official validator says of them."""

import csv
import json
import time
import tracemalloc
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from worker.errors import WorkerError
from worker.models.gltf.outline import outline
from worker.models.gltf.reader import read
from worker.models.model import Model

CODES = {"asset_unusable", "asset_unsupported", "asset_too_large", "asset_file_missing"}
VALIDATOR = "4_hostile/gltf_validator"
ASSIMP = "4_hostile/mesh_assimp/glTF2"

# What was measured for FACTS.csv knows neither lines nor fans, and leaves morph targets out. The
# bounds here are those of the files' own min and max, plus half of the morph target's.
OTHER_BOUNDS = {
    "khronos/Mesh_PrimitiveMode/Mesh_PrimitiveMode_02.gltf": ([-0.5, -0.5, 0], [0.5, 0.5, 0]),
    "khronos/Mesh_PrimitiveMode/Mesh_PrimitiveMode_03.gltf": ([-0.5, -0.5, 0], [0.5, 0.5, 0]),
    "khronos/Mesh_PrimitiveMode/Mesh_PrimitiveMode_05.gltf": ([-0.5, -0.5, 0], [0.5, 0.5, 0]),
    "khronos/MorphPrimitivesTest/glTF/MorphPrimitivesTest.gltf": ([-0.5, 0, -0.5], [0.5, 0.1, 0.5]),
}
DRAWN = {  # points or lines of Mesh_PrimitiveMode: 1024 points and a square of four sides
    "Mesh_PrimitiveMode_00": ("points", 1024),
    "Mesh_PrimitiveMode_01": ("lines", 4),
    "Mesh_PrimitiveMode_02": ("lines", 4),
    "Mesh_PrimitiveMode_03": ("lines", 4),
    "Mesh_PrimitiveMode_07": ("points", 1024),
}


def read_file(path: Path) -> Model:
    beside = {p.name: p.read_bytes() for p in path.parent.iterdir() if p.is_file()}
    return read(path.read_bytes(), beside)


def bounds(model: Model) -> tuple[np.ndarray, np.ndarray]:
    placed = np.concatenate(
        [p.mesh.positions @ p.matrix[:3, :3].T + p.matrix[:3, 3] for p in model.parts]
    )
    return placed.min(axis=0), placed.max(axis=0)


def gltf_files(folder: Path) -> list[Path]:
    return sorted(p for p in folder.rglob("*") if p.suffix in (".gltf", ".glb"))


@pytest.mark.corpus
def test_models_have_the_triangles_and_bounds_that_others_measured(corpus: Path) -> None:
    with (corpus / "1_models/FACTS.csv").open() as table:
        rows = [r for r in csv.DictReader(table) if r["gltf_validator_errors"] == "0"]

    assert len(rows) == 19
    for row in rows:
        model = read_file(corpus / "1_models" / row["file"])
        distinct = {part.key: part.mesh for part in model.parts}.values()
        triangles = sum(len(mesh.triangles) for mesh in distinct if mesh.kind == "triangles")
        lowest, highest = (
            OTHER_BOUNDS[row["file"]]
            if row["file"] in OTHER_BOUNDS
            else (json.loads(row["bounds_min"]), json.loads(row["bounds_max"]))
        )
        low, high = bounds(model)

        assert triangles == int(row["gltf_validator_triangles"]), row["file"]
        assert low == pytest.approx(lowest, abs=1e-5), row["file"]
        assert high == pytest.approx(highest, abs=1e-5), row["file"]


@pytest.mark.corpus
def test_lines_and_points_are_read_as_such(corpus: Path) -> None:
    for name, (kind, count) in DRAWN.items():
        model = read_file(corpus / f"1_models/khronos/Mesh_PrimitiveMode/{name}.gltf")

        assert [(p.mesh.kind, len(p.mesh.triangles)) for p in model.parts] == [(kind, count)], name


@pytest.mark.corpus
def test_three_packagings_of_one_box_are_one_model(corpus: Path) -> None:
    khronos = corpus / "1_models/khronos"
    paths = (
        "BoxTextured.glb",
        "BoxTextured-embedded/BoxTextured.gltf",
        "BoxTextured-separate/BoxTextured.gltf",
    )
    (binary,), (embedded,), (separate,) = (read_file(khronos / path).parts for path in paths)

    for other in (embedded, separate):
        assert np.array_equal(binary.mesh.positions, other.mesh.positions)
        assert np.array_equal(binary.mesh.uv_sets[0], other.mesh.uv_sets[0])
        assert np.array_equal(binary.mesh.triangles, other.mesh.triangles)
        assert np.array_equal(binary.matrix, other.matrix)


@pytest.mark.corpus
def test_the_milk_truck_has_its_wheels_twice_and_once_in_memory(corpus: Path) -> None:
    model = read_file(corpus / "1_models/khronos/CesiumMilkTruck.glb")

    names = [surface.name for surface in model.surfaces]
    wheels = [part for part in model.parts if part.material == names.index("wheels")]
    assert names == ["truck", "glass", "window_trim", "wheels"]
    assert len(wheels) == 2
    assert wheels[0].mesh is wheels[1].mesh
    assert len({part.key for part in model.parts}) == 4


@pytest.mark.corpus
def test_a_file_alone_tells_what_it_tells_with_those_beside_it(corpus: Path) -> None:
    khronos = corpus / "1_models/khronos"
    alone = outline((khronos / "BoxTextured-separate/BoxTextured.gltf").read_bytes())
    whole = outline((khronos / "BoxTextured-embedded/BoxTextured.gltf").read_bytes())

    assert alone.files == ("BoxTextured0.bin", "CesiumLogoFlat.png")
    assert whole.files == ()
    assert len(whole.pictures) == 1
    assert alone == replace(whole, files=alone.files, pictures=())


@pytest.mark.corpus
def test_what_the_official_validator_calls_an_error_is_refused_and_nothing_else(
    corpus: Path,
) -> None:
    files = gltf_files(corpus / VALIDATOR)

    assert len(files) == 118
    for path in files:
        report = json.loads(path.with_name(f"{path.name}.report.json").read_text())
        errors = report["issues"]["numErrors"]
        assert (refusal(lambda path=path: read_file(path)) is None) == (errors == 0), path.name


@pytest.mark.corpus
def test_broken_files_are_refused_at_once_and_in_little_memory(corpus: Path) -> None:
    files = gltf_files(corpus / ASSIMP)

    assert len(files) == 10
    for path in files:
        assert refusal(lambda path=path: read_file(path)) is not None, path.name


def refusal(action: Callable[[], object]) -> str | None:
    """The code of a refusal, if it is one; quick and small either way."""
    tracemalloc.start()
    started = time.monotonic()
    code = None
    try:
        action()
    except WorkerError as error:
        code = error.code
        assert code in CODES
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    assert time.monotonic() - started < 10  # alone it takes some hundredths
    assert peak < 20 * 2**20
    return code
