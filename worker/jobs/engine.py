"""The embedded engine: records, files and slots of one data folder, behind one class."""

import asyncio
import fcntl
import threading
import time
from dataclasses import dataclass
from pathlib import Path
from typing import IO, Any

from worker.jobs.assets import Assets
from worker.jobs.bell import Bell
from worker.jobs.claims import Claims
from worker.jobs.database import Database
from worker.jobs.environment import child_environment
from worker.jobs.errors import DataFolderInUseError, DrainingError
from worker.jobs.files import keep_only, make_folder
from worker.jobs.forkserver import start_forkserver
from worker.jobs.job import FINAL_STATES, Job, Priority, State
from worker.jobs.line import Line
from worker.jobs.measuring import Measuring
from worker.jobs.migrations import upgrade
from worker.jobs.requests import Request, Requests
from worker.jobs.results import Results
from worker.jobs.slot import Slot
from worker.jobs.slot_thread import Desk, SlotThread


@dataclass(frozen=True, slots=True)
class Readiness:
    """How the engine is; `fingerprint` names the platform its children run on, once one is warm."""

    slots: int
    warm_slots: int
    fingerprint: str | None
    draining: bool
    queued: int
    running: int


class EmbeddedEngine:
    """Does jobs in child processes of this one, and never loses any.

    Start it in the main thread, or after `start_forkserver` was called there; then use it from any.

    Args:
        data: folder of records, results, assets and caches; created if missing.
        slots: how much work is done at a time.
        queue_limit: how much work may wait.
        time_limit_seconds: what a job may take unless it says otherwise.
        memory_limit_bytes: what a child may hold resident.
        executor: name of the module that does jobs.
        measurer: name of the module that measures uploads.
        gl: the children's OpenGL platform, `osmesa` or `egl`.
        native_cpu: whether children compile for this very machine.
    """

    def __init__(
        self,
        data: Path,
        *,
        slots: int = 2,
        queue_limit: int = 256,
        time_limit_seconds: float = 600,
        memory_limit_bytes: int = 4 << 30,
        executor: str = "worker.run_job",
        measurer: str = "worker.measure_asset",
        gl: str = "osmesa",
        native_cpu: bool = False,
    ) -> None:
        self._data = data = make_folder(data.resolve())
        self._environment = child_environment(data, gl=gl, native_cpu=native_cpu)
        self._time_limit_seconds = time_limit_seconds
        self._draining = threading.Event()
        self._bell = Bell()
        self._database = Database(data / "jobs.sqlite")
        self._results = Results(data / "results")
        self.assets = Assets(data / "assets", self._database)
        self._claims = Claims(self._database)
        self._line = Line(self._claims)
        self._requests = Requests(
            self._database, queue_limit=queue_limit, slots=slots, is_reusable=self._is_reusable
        )
        desk = Desk(self._line, self._claims, self._results, self.assets, self._bell.ring)

        def slot(module: str) -> Slot:
            return Slot(module, self._environment, memory_limit_bytes=memory_limit_bytes)

        self._lock: IO[bytes] | None = None
        self._threads = [SlotThread(f"slot-{n}", slot(executor), desk) for n in range(slots)]
        self._measuring = Measuring(slot(measurer), self.assets.folder)

    def start(self) -> None:
        """Take the data folder, put back what was interrupted, and warm all slots up.

        Raises:
            DataFolderInUseError: another engine has the data folder.
            RuntimeError: no forkserver was started, and this is not the main thread.
        """
        start_forkserver()
        self._lock = lock_folder(self._data)
        upgrade(self._database)
        self._claims.recover()
        self._results.sweep()
        self.assets.sweep()
        keep_only(Path(self._environment["NUMBA_CACHE_DIR"]))
        make_folder(Path(self._environment["MESA_SHADER_CACHE_DIR"]))
        for thread in self._threads:
            thread.start()

    def drain(self, timeout_seconds: float) -> None:
        """Take nothing new, finish what is running, and stop.

        What is not finished in time goes back into the queue, and is done after the next start.
        """
        self._draining.set()
        for thread in self._threads:
            thread.stop()
        self._line.announce()
        deadline = time.monotonic() + timeout_seconds
        for thread in self._threads:
            thread.join(max(0.0, deadline - time.monotonic()))
        for thread in self._threads:
            thread.abandon()
        for thread in self._threads:
            thread.join()
        self._measuring.close()
        self._database.close()
        if self._lock is not None:
            self._lock.close()

    def submit(
        self,
        kind: str,
        body: dict[str, Any],
        digest: str,
        *,
        tenant: str,
        priority: Priority = "interactive",
        time_limit_seconds: float | None = None,
    ) -> Job:
        """Record a job, which is succeeded at once if the tenant has a result of the digest.

        Raises:
            DrainingError: the engine is stopping.
            QueueFullError: too much is waiting.
            StorageFullError: the disk is full.
        """
        if self._draining.is_set():
            raise DrainingError("the engine is stopping")
        limit = self._time_limit_seconds if time_limit_seconds is None else time_limit_seconds
        job = self._requests.submit(Request(tenant, kind, body, digest, priority, limit))
        if job.state == "queued":
            self._line.announce()
        return job

    def get(self, tenant: str, job_id: str) -> Job | None:
        """One job of the tenant."""
        return self._requests.get(tenant, job_id)

    def list(
        self,
        tenant: str,
        *,
        cursor: str | None = None,
        limit: int = 50,
        state: State | None = None,
    ) -> tuple[list[Job], str | None]:
        """Jobs of the tenant, newest first, and the cursor of the next page if there is one.

        A cursor is 16 hexadecimal digits, and any such is good.
        """
        return self._requests.list(tenant, cursor=cursor, limit=limit, state=state)

    def cancel(self, tenant: str, job_id: str) -> Job | None:
        """Cancel a job; one that is finished stays as it is."""
        job = self._requests.cancel(tenant, job_id)
        if job is not None and job.state == "cancelled":
            if not self._claims.is_live(job.work_id):
                self._line.cancel(job.work_id)
            self._bell.ring(job.work_id)
        return job

    async def finished(self, tenant: str, job_id: str, timeout_seconds: float) -> Job | None:
        """The job as soon as it is finished, or as it is when the time is up."""
        job = await asyncio.to_thread(self.get, tenant, job_id)
        if job is None or job.state in FINAL_STATES:
            return job
        deadline = asyncio.get_running_loop().time() + timeout_seconds
        with self._bell.listening(job.work_id) as rung:
            while True:
                rung.clear()
                job = await asyncio.to_thread(self.get, tenant, job_id)
                if job is None or job.state in FINAL_STATES:
                    return job
                try:
                    async with asyncio.timeout_at(deadline):
                        await rung.wait()
                except TimeoutError:
                    return job

    def result_path(self, job: Job) -> Path | None:
        """The result of a succeeded job; None when it was evicted."""
        return self._results.find(job.work_id)

    def measure(
        self, path: Path, time_limit_seconds: float, media_type: str = ""
    ) -> dict[str, Any]:
        """The facts of a file, found in a child; callable from any thread.

        `media_type` is what the uploader calls it, for files whose content does not tell.

        Raises:
            MeasuringError: the file is unusable; `failure` says why.
            SlotError: no child could be started.
        """
        return self._measuring.measure(path, time_limit_seconds, media_type)

    def ready(self) -> Readiness:
        """What an operator wants to know."""
        counts = self._claims.counts()
        return Readiness(
            slots=len(self._threads),
            warm_slots=sum(thread.is_warm for thread in self._threads),
            fingerprint=self._fingerprint(),
            draining=self._draining.is_set(),
            queued=counts.get("queued", 0),
            running=counts.get("running", 0),
        )

    def _fingerprint(self) -> str | None:
        return next((one.fingerprint for one in self._threads if one.fingerprint), None)

    def _is_reusable(self, work_id: str, fingerprint: str | None) -> bool:
        """Whether a result is still there, and no warm child says that it comes from elsewhere."""
        return self._fingerprint() in (None, fingerprint) and (
            self._results.find(work_id) is not None
        )


def lock_folder(data: Path) -> IO[bytes]:
    """Make the data folder this process's own until the answer is closed.

    Raises:
        DataFolderInUseError: another engine has it.
    """
    lock = (data / "lock").open("ab")
    try:
        fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except OSError as error:
        lock.close()
        raise DataFolderInUseError(f"another service uses {data}") from error
    return lock
