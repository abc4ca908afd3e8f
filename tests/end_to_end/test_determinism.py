"""Equal requests give equal bytes, whatever draws them."""

import hashlib
import json
import os
import subprocess
import sys

import pytest

from tests.examples import EXAMPLES
from tests.running_service import ROOT

pytestmark = [pytest.mark.end_to_end, pytest.mark.gl]

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
    assert done.returncode == 0, done.stderr
    return done.stdout.split()


def test_threads_and_opengl_platforms_change_no_byte(tmp_path):
    pictures = {
        (gl, threads): drawn(
            tmp_path / f"{gl}{threads}", gl, LP_NUM_THREADS=threads, NUMBA_NUM_THREADS=numba
        )
        for gl, threads, numba in (
            ("osmesa", "1", "1"),
            ("osmesa", "2", "2"),
            ("osmesa", "4", "2"),
            ("egl", "2", "2"),
        )
    }

    assert len(pictures["osmesa", "1"]) == 3
    assert set(map(tuple, pictures.values())) == {tuple(pictures["osmesa", "1"])}


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
