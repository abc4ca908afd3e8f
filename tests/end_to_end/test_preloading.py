"""What workers have in common is loaded once, where no thread can be in its way."""

from pathlib import Path

import pytest

pytestmark = [pytest.mark.end_to_end, pytest.mark.gl]


def children(pid):
    return [int(child) for child in Path(f"/proc/{pid}/task/{pid}/children").read_text().split()]


def kilobytes(pid, what):
    told = Path(f"/proc/{pid}/smaps_rollup").read_text()
    return int(told.split(f"{what}:")[1].split()[0])


@pytest.fixture(scope="module")
def forkserver(service):
    """The process that has the workers for children."""
    (found,) = [pid for pid in service.processes() if pid != service.process.pid and children(pid)]
    return found


def test_the_forkserver_has_loaded_the_worker_and_runs_no_thread(forkserver):
    assert len(list(Path(f"/proc/{forkserver}/task").iterdir())) == 1
    loaded = Path(f"/proc/{forkserver}/maps").read_text()
    for library in ("numpy", "llvmlite", "OpenImageIO", "scipy"):
        assert library in loaded


def test_workers_share_what_was_loaded(forkserver):
    for worker in children(forkserver):
        shared = kilobytes(worker, "Shared_Dirty")
        # Alone, the modules of one worker are 100 MB that only it has
        assert shared > 50_000
