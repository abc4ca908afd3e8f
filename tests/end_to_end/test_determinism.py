"""Equal requests give equal bytes, whatever draws them."""

import hashlib
import json
import os
import subprocess
import sys

import pytest

from tests.examples import EXAMPLES
from tests.requirements import skip_or_fail
from tests.running_service import ROOT

pytestmark = [pytest.mark.end_to_end, pytest.mark.gl]

HERE = os.environ["PYOPENGL_PLATFORM"]
PROGRAM = """
import os, sys
from pathlib import Path
from worker.jobs.environment import child_environment
os.environ |= child_environment(Path(".cache").resolve(), gl=sys.argv[1], native_cpu=False)
from tests.run_example import run_example
for name in ("labelled_can", "shapes", "ramp"):
    out = Path(sys.argv[2]) / f"{name}.exr"
    size = [200, 150]
    print(run_example(name, out, Path(sys.argv[2]), size=size, format="exr")["sha256"])
"""


def drawn(folder, gl, **environment):
    """The hashes of three examples, drawn by a process of its own."""
    folder.mkdir()
    done = subprocess.run(
        [sys.executable, "-c", PROGRAM, gl, str(folder)],
        cwd=ROOT,
        env={**os.environ, "PYTHONPATH": str(ROOT), **environment},
        capture_output=True,
        text=True,
    )
    if done.returncode and gl != HERE:
        skip_or_fail(f"no {gl} here: {done.stderr.strip().splitlines()[-1]}", "REQUIRE_GL")
    assert done.returncode == 0, done.stderr
    return done.stdout.split()


@pytest.fixture(scope="module")
def reference(tmp_path_factory):
    folder = tmp_path_factory.mktemp("reference") / "pictures"
    return drawn(folder, HERE, LP_NUM_THREADS="1", NUMBA_NUM_THREADS="1")


@pytest.mark.parametrize(("threads", "numba"), [("2", "2"), ("4", "2")])
def test_the_number_of_threads_changes_no_byte(reference, tmp_path, threads, numba):
    again = drawn(tmp_path / "again", HERE, LP_NUM_THREADS=threads, NUMBA_NUM_THREADS=numba)

    assert len(reference) == 3
    assert again == reference


@pytest.mark.parametrize("gl", ["osmesa", "egl"])
def test_the_opengl_platform_changes_no_byte(reference, tmp_path, gl):
    assert drawn(tmp_path / "again", gl, LP_NUM_THREADS="2", NUMBA_NUM_THREADS="2") == reference


def test_the_number_of_workers_changes_no_byte(make_service):
    body = json.loads((EXAMPLES / "renders/soda_can.json").read_text())
    found = set()
    for slots in ("1", "2"):
        with make_service(slots=slots).client() as client:
            bodies = [{**body, "output": {"size": [64, 64 + n]}} for n in range(4)]
            jobs = [client.post("/v1/renders", json=b).json() for b in bodies]
            answers = [
                client.post("/v1/renders", json=b, headers={"Accept": "image/png"}) for b in bodies
            ]
            assert [a.headers["texloom-digest"] for a in answers] == [j["digest"] for j in jobs]
            found.add(tuple(hashlib.sha256(a.content).hexdigest() for a in answers))

    assert len(found) == 1
