"""The embedded engine: records, files and slots of one data folder, behind one class."""

import asyncio
import threading
import time
from functools import partial
from pathlib import Path
from typing import Any

from worker.jobs.batches import Batches
from worker.jobs.bell import Bell
from worker.jobs.claims import Claims
from worker.jobs.crew import Crew
from worker.jobs.data_folder import DataFolder
from worker.jobs.environment import child_environment
from worker.jobs.errors import DrainingError
from worker.jobs.forecast import Forecast
from worker.jobs.forkserver import EXECUTOR, start_forkserver
from worker.jobs.idempotency import Key
from worker.jobs.intake import Request
from worker.jobs.job import FINAL_STATES, Job, Priority, State
from worker.jobs.line import Line
from worker.jobs.measuring import Measuring
from worker.jobs.meters import Meters
from worker.jobs.requests import Requests
from worker.jobs.results import Limits
from worker.jobs.room import Room
from worker.jobs.run_times import RunTimes
from worker.jobs.settling import Desk
from worker.jobs.slot import Slot
from worker.jobs.status import Readiness, Status, queues
from worker.jobs.watch import Watch


class EmbeddedEngine:
    """Does jobs in child processes of this one, and never loses any.

    Start it in the main thread, or after `start_forkserver` was called there; then use it from any.

    Args:
        data: folder of records, results, assets and caches; created if missing.
        slots: how much work is done at a time.
        queue_limit: how much work may wait.
        tenant_queue_limit: how much of it may be one tenant's.
        recycle_after: how many jobs a child does before a fresh one takes its place.
        time_limit_seconds: what a job may take unless it says otherwise.
        memory_limit_bytes: what a child may hold resident.
        keep: how many results are kept, and for how long.
        assets_bytes_limit: what all uploads may take together.
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
        tenant_queue_limit: int = 256,
        recycle_after: int = 1000,
        keep: Limits | None = None,
        assets_bytes_limit: int = 20 << 30,
        time_limit_seconds: float = 600,
        memory_limit_bytes: int = 4 << 30,
        executor: str = EXECUTOR,
        measurer: str = "worker.measure_asset",
        gl: str = "osmesa",
        native_cpu: bool = False,
    ) -> None:
        self.meters = Meters()
        self._data = DataFolder(
            data, keep=keep, assets_bytes_limit=assets_bytes_limit, meters=self.meters
        )
        self.assets = self._data.assets
        self._environment = child_environment(self._data.path, gl=gl, native_cpu=native_cpu)
        self._time_limit_seconds = time_limit_seconds
        self._draining = threading.Event()
        self._started = time.monotonic()
        self._bell = Bell()
        database = self._data.database
        self._claims = Claims(database, slots)
        self._line = Line(self._claims)
        self._run_times = RunTimes()
        room = Room(
            queue_limit=queue_limit,
            tenant_limit=tenant_queue_limit,
            slots=slots,
            run_times=self._run_times,
            meters=self.meters,
        )
        self._requests = Requests(
            database, room=room, meters=self.meters, is_reusable=self._is_reusable
        )
        self.batches = Batches(
            database,
            room=room,
            is_reusable=self._is_reusable,
            require_open=self._require_open,
            arrived=partial(self._line.announce, slots),
            unwanted=self._stop_unwanted,
        )
        self.forecast = Forecast(database, slots)
        self.watch = Watch(self._requests.look)
        database.on_write(self.watch.wake)
        desk = Desk(
            line=self._line,
            claims=self._claims,
            results=self._data.results,
            assets=self.assets,
            run_times=self._run_times,
            meters=self.meters,
            settled=self._bell.ring,
            warming=threading.Lock(),
        )

        def slot(module: str) -> Slot:
            return Slot(module, self._environment, memory_limit_bytes=memory_limit_bytes)

        self._crew = Crew(slots, partial(slot, executor), desk, recycle_after)
        self._measuring = Measuring(slot(measurer), self.assets.folder)

    def start(self) -> None:
        """Take the data folder, put back what was interrupted, and warm all slots up.

        Raises:
            DataFolderInUseError: another engine has the data folder.
            RecordsError: its records are damaged, or of a newer version.
            StorageFullError: the disk is full.
            RuntimeError: no forkserver was started, and this is not the main thread.
        """
        start_forkserver()
        self._data.take(self._environment)
        self._claims.recover()
        self._run_times.recall(self._data.database)
        self._crew.start()
        self.watch.start()

    def drain(self, timeout_seconds: float) -> None:
        """Take nothing new, finish what is running, and stop.

        What is not finished in time goes back into the queue, and is done after the next start.
        """
        self._draining.set()
        self._crew.drain(timeout_seconds)
        self._measuring.close()
        self.watch.close()
        self._data.let_go()

    def submit(
        self,
        kind: str,
        body: dict[str, Any],
        digest: str,
        *,
        tenant: str,
        priority: Priority = "interactive",
        time_limit_seconds: float | None = None,
        estimate_seconds: float | None = None,
        key: Key | None = None,
    ) -> Job:
        """Record a job, which is succeeded at once if the tenant has a result of the digest.

        With a key that was sent before it answers the job that was recorded then.

        Raises:
            DrainingError: the engine is stopping.
            QueueFullError: too much is waiting.
            StorageFullError: the disk is full.
            KeyReusedError: the key came with another body before.
        """
        self._require_open()
        limit = self._time_limit_seconds if time_limit_seconds is None else time_limit_seconds
        request = Request(tenant, kind, body, digest, priority, limit, estimate_seconds)
        job = self._requests.submit(request, key)
        if job.state == "queued":
            self._line.announce()
        self._data.database.flush()  # a slot is at it already
        return job

    def replayed(self, tenant: str, key: Key) -> Job | None:
        """The job that a key stands for; None if it is new.

        Raises:
            KeyReusedError: the key came with another body before.
        """
        job = self._requests.replayed(tenant, key)
        if job is not None:
            self._data.database.flush()  # whoever recorded it may not have come to that yet
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
            self._stop_unwanted(job.work_id)
        return job

    async def finished(self, job: Job, timeout_seconds: float) -> Job:
        """A job as soon as it is finished, or as it is when the time is up."""

        async def is_over() -> bool:
            nonlocal job
            known = await asyncio.to_thread(self.get, job.tenant, job.id)
            job = known or job
            return job.state in FINAL_STATES

        if job.state not in FINAL_STATES:
            await self._bell.until(job.work_id, is_over, timeout_seconds)
        return job

    def result_path(self, job: Job) -> Path | None:
        """The result of a succeeded job; None when it was evicted."""
        return self._data.results.find(job.work_id)

    def preview_path(self, job: Job) -> Path | None:
        """A picture of how far a job is, a PNG; None while there is none."""
        path = self._data.results.preview(job.work_id)
        return path if path.is_file() else None

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
        """Whether work would be done."""
        counts = self._claims.counts()
        return Readiness(
            slots=len(self._crew),
            warm_slots=self._crew.warm,
            fingerprint=self._crew.fingerprint,
            draining=self._draining.is_set(),
            queued=counts.get("queued", 0),
            running=counts.get("running", 0),
        )

    def status(self) -> Status:
        """How it is, for people and meters."""
        return Status(
            draining=self._draining.is_set(),
            uptime_seconds=time.monotonic() - self._started,
            fingerprint=self._crew.fingerprint,
            typical_seconds=self._run_times.typical(),
            queues=queues(self._data.database),
            slots=self._crew.status(),
            store=self._data.status(),
        )

    def _require_open(self) -> None:
        if self._draining.is_set():
            raise DrainingError("the engine is stopping")

    def _stop_unwanted(self, work_id: str) -> None:
        """Stop work if no job wants it any more, and tell those who wait for it."""
        if not self._claims.is_live(work_id):
            self._line.cancel(work_id)
        self._bell.ring(work_id)

    def _is_reusable(self, work_id: str, fingerprint: str | None) -> bool:
        """Whether a result is still there, and no warm child says that it comes from elsewhere."""
        return self._crew.fingerprint in (None, fingerprint) and (
            self._data.results.find(work_id) is not None
        )
