"""The wheel holds everything the clone holds, and works where there is no clone."""

import os
import shutil
import subprocess
import sys
import zipfile
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parent.parent
PACKAGES = ("api_schemas", "service", "worker")


@pytest.fixture(scope="module")
def wheel(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The wheel of this tree, built from a copy so that nothing is left behind in it."""
    folder = tmp_path_factory.mktemp("packaging")
    copy = folder / "source"
    for package in PACKAGES:
        shutil.copytree(
            ROOT / package, copy / package, ignore=shutil.ignore_patterns("__pycache__")
        )
    for name in ("pyproject.toml", "README.md"):
        shutil.copy(ROOT / name, copy)
    run("-m", "build", "--wheel", "--no-isolation", "--outdir", folder, copy)
    return next(folder.glob("*.whl"))


@pytest.fixture(scope="module")
def installed(wheel: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """An otherwise empty folder with the wheel's content."""
    folder = tmp_path_factory.mktemp("installed")
    run("-m", "pip", "install", "--no-index", "--no-deps", "--target", folder, wheel)
    return folder


def run(*arguments: str | Path, folder: Path = ROOT, python_path: Path | None = None) -> str:
    environment = dict(os.environ)
    if python_path:
        environment["PYTHONPATH"] = str(python_path)
    finished = subprocess.run(
        [sys.executable, *arguments], cwd=folder, env=environment, capture_output=True, text=True
    )
    assert finished.returncode == 0, finished.stderr or finished.stdout
    return finished.stdout


def test_the_wheel_holds_every_file_of_the_packages(wheel: Path) -> None:
    expected = {
        str(path.relative_to(ROOT))
        for package in PACKAGES
        for path in (ROOT / package).rglob("*")
        if path.is_file() and "__pycache__" not in path.parts
    }

    packed = {name for name in zipfile.ZipFile(wheel).namelist() if ".dist-info/" not in name}

    assert packed == expected


# As a service from the wheel does: the executor alone, on an example that came with the wheel.
WORK = """
import json, sys
from pathlib import Path
import api_schemas, worker
from api_schemas.digest import digest
from api_schemas.normalise import normalise
from api_schemas.requests import REQUESTS
from worker import run_job

kind, example, target = sys.argv[1], sys.argv[2], Path(sys.argv[3])
assert Path(worker.__file__).is_relative_to(target), worker.__file__
body = json.loads((Path(api_schemas.__file__).parent / "examples" / example).read_text())
body["output"] = {"size": [32, 32], "format": "png"}
request = normalise(REQUESTS[kind].model_validate(body), "png", {})
job = {
    "kind": kind,
    "body": request.model_dump(mode="json"),
    "digest": digest(request),
    "assets": str(Path.cwd()),
    "preview": str(Path.cwd() / "preview"),
}
run_job.run(job, Path("picture.png"), lambda progress, stage: None)
"""


@pytest.mark.parametrize(
    ("kind", "example"),
    [
        ("texture", "textures/perlin.json"),
        pytest.param("render", "renders/soda_can.json", marks=pytest.mark.gl),
    ],
)
def test_the_wheel_makes_pictures_in_an_empty_folder(
    installed: Path, tmp_path: Path, kind: str, example: str
) -> None:
    run("-c", WORK, kind, example, installed, folder=tmp_path, python_path=installed)

    assert (tmp_path / "picture.png").read_bytes().startswith(b"\x89PNG\r\n\x1a\n")


def test_the_wheel_brings_its_database_up_to_date(installed: Path, tmp_path: Path) -> None:
    program = """
import sys
from pathlib import Path
from sqlalchemy import inspect
import worker
from worker.jobs.database import Database
from worker.jobs.migrations import upgrade

assert Path(worker.__file__).is_relative_to(sys.argv[1]), worker.__file__
database = Database(Path("records.sqlite"))
upgrade(database)
with database.reading() as connection:
    print(*inspect(connection).get_table_names())
database.close()
"""

    tables = run("-c", program, installed, folder=tmp_path, python_path=installed)

    assert {"jobs", "work", "assets"} <= set(tables.split())
