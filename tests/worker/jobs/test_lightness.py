"""The door stays light: what the forkserver holds is paid for by every child."""

import subprocess
import sys

import pytest

NATIVE = "numpy numba scipy OpenGL pyrender OpenImageIO trimesh fastapi starlette uvicorn pydantic"


def loaded_by(module, names):
    script = (
        f"import sys, {module}\n"
        f"sys.stdout.write(' '.join(sorted(set({names.split()}) & set(sys.modules))))"
    )
    answer = subprocess.run(
        [sys.executable, "-c", script], capture_output=True, text=True, check=True
    )
    return answer.stdout


def test_the_engine_loads_no_native_code():
    assert loaded_by("worker.jobs.engine", NATIVE) == ""


def test_a_child_of_a_forkserver_that_was_not_prepared_says_so():
    script = "from worker.jobs.child import become_expendable; become_expendable()"
    told = subprocess.run(
        [sys.executable, "-c", script], capture_output=True, text=True, check=True
    )
    assert "worker.jobs.preload was not loaded" in told.stderr


def test_a_forkserver_in_which_a_thread_runs_does_not_come_up():
    script = (
        "import threading\n"
        "threading.Thread(target=threading.Event().wait, daemon=True).start()\n"
        "import worker.jobs.preloaded"
    )
    told = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True)
    assert told.returncode == 1
    assert "2 threads run in the forkserver" in told.stderr


@pytest.mark.parametrize("module", ["worker.jobs.preload", "worker.jobs.slot"])
def test_a_child_starts_without_the_records(module):
    assert loaded_by(module, f"{NATIVE} sqlalchemy alembic asyncio") == ""
