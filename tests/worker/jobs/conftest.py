"""Real slots with real processes, whose executor does what a test asks it to."""

import os
import sys
import time
from pathlib import Path

import pytest

from worker.jobs.database import Database
from worker.jobs.engine import EmbeddedEngine
from worker.jobs.forkserver import start_forkserver
from worker.jobs.job import FINAL_STATES
from worker.jobs.meters import Meters
from worker.jobs.migrations import upgrade
from worker.jobs.requests import Requests
from worker.jobs.room import Room
from worker.jobs.run_times import RunTimes

EXECUTORS = str(Path(__file__).parent / "executors")


@pytest.fixture(scope="session", autouse=True)
def forkserver():
    """Children get the path of modules from this process, so the executors are found by name."""
    sys.path.insert(0, EXECUTORS)
    start_forkserver()
    yield
    sys.path.remove(EXECUTORS)


@pytest.fixture
def make_engine(tmp_path):
    """Makes started engines on one data folder and drains them at the end."""
    started = []

    def make(**options):
        defaults = {
            "slots": 1,
            "memory_limit_bytes": 1 << 30,
            "executor": "trial_executor",
            "measurer": "trial_measurer",
        }
        engine = EmbeddedEngine(tmp_path / "data", **(defaults | options))
        engine.start()
        started.append(engine)
        return engine

    yield make
    for engine in started:
        engine.drain(0)


@pytest.fixture
def engine(make_engine):
    return make_engine()


@pytest.fixture
def submit():
    """Submits `body` with a digest of its own unless told."""

    def submit(engine, digest=None, *, tenant="local", priority="interactive", limit=30.0, **body):
        digest = digest or os.urandom(32).hex()
        return engine.submit(
            "texture", body, digest, tenant=tenant, priority=priority, time_limit_seconds=limit
        )

    return submit


@pytest.fixture
def database(tmp_path):
    database = Database(tmp_path / "jobs.sqlite")
    upgrade(database)
    yield database
    database.close()


@pytest.fixture
def make_requests(database):
    """Makes the callers' side of the records, with room and run times as a test wants them."""

    def make(*, queue_limit=9, tenant_limit=9, slots=1, run_times=None, is_reusable=None):
        room = Room(
            queue_limit=queue_limit,
            tenant_limit=tenant_limit,
            slots=slots,
            run_times=run_times or RunTimes(),
            meters=Meters(),
        )
        return Requests(
            database,
            room=room,
            meters=Meters(),
            is_reusable=is_reusable or (lambda *_: False),
        )

    return make


@pytest.fixture
def wait_until():
    """Waits for something to become true, and returns it."""

    def wait_until(is_so, seconds=30.0):
        deadline = time.monotonic() + seconds
        while not (answer := is_so()):
            assert time.monotonic() < deadline, "it did not happen in time"
            time.sleep(0.005)
        return answer

    return wait_until


@pytest.fixture
def begin(wait_until):
    """Waits until a job is running and returns it."""

    def begin(engine, job):
        wait_until(lambda: engine.get(job.tenant, job.id).state == "running")
        return job

    return begin


@pytest.fixture
def is_gone():
    """Whether a process has ended; what nobody has reaped yet has ended too."""

    def is_gone(pid):
        try:
            return Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[0] in "ZX"
        except (FileNotFoundError, ProcessLookupError):
            return True

    return is_gone


@pytest.fixture
def finish(wait_until):
    """Waits for the end of a job and returns it."""

    def finish(engine, job, seconds=30.0):
        def finished():
            now = engine.get(job.tenant, job.id)
            return now if now.state in FINAL_STATES else None

        return wait_until(finished, seconds)

    return finish
