"""What the service needs of an engine, embedded or spread over many machines."""

from pathlib import Path
from typing import Any, Protocol

from worker.jobs.assets import Assets
from worker.jobs.batches import Batches
from worker.jobs.forecast import Forecast
from worker.jobs.idempotency import Key
from worker.jobs.job import Job, Priority, State
from worker.jobs.meters import Meters
from worker.jobs.status import Readiness, Status
from worker.jobs.watch import Watch


class JobQueue(Protocol):
    """Jobs are submitted, followed, cancelled and fetched; draining ends it.

    A row in the records is the truth about a job: whatever carries the work to those who do it, and
    however often, knows no more than its id.
    """

    @property
    def assets(self) -> Assets:
        """What tenants uploaded."""

    @property
    def batches(self) -> Batches:
        """Many jobs asked for at once."""

    @property
    def forecast(self) -> Forecast:
        """When jobs will be finished."""

    @property
    def watch(self) -> Watch:
        """News of jobs for those who follow them."""

    @property
    def meters(self) -> Meters:
        """What is counted."""

    def start(self) -> None:
        """Take the records over, put back what was interrupted, and become able to work.

        Raises:
            JobsError: the records cannot be had.
        """

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
        """Record a job; once this returns, no crash and no power cut loses it.

        It has succeeded at once if the tenant has a result of the digest. With a key that was sent
        before it answers the job that was recorded then.

        Raises:
            DrainingError: the engine is stopping.
            QueueFullError: too much is waiting.
            StorageFullError: there is no room for the record.
            KeyReusedError: the key came with another body before.
        """

    def replayed(self, tenant: str, key: Key) -> Job | None:
        """The job that a key stands for; None if it is new.

        Raises:
            KeyReusedError: the key came with another body before.
        """

    def get(self, tenant: str, job_id: str) -> Job | None:
        """One job of the tenant."""

    def list(
        self,
        tenant: str,
        *,
        cursor: str | None = None,
        limit: int = 50,
        state: State | None = None,
    ) -> tuple[list[Job], str | None]:
        """Jobs of the tenant, newest first, and the cursor of the next page if there is one."""

    def cancel(self, tenant: str, job_id: str) -> Job | None:
        """Cancel a job; one that is finished stays as it is."""

    async def finished(self, job: Job, timeout_seconds: float) -> Job:
        """A job as soon as it is finished, or as it is when the time is up."""

    def result_path(self, job: Job) -> Path | None:
        """The result of a succeeded job; None when it was evicted."""

    def preview_path(self, job: Job) -> Path | None:
        """A picture of how far a job is, a PNG; None while there is none."""

    def measure(
        self, path: Path, time_limit_seconds: float, media_type: str = ""
    ) -> dict[str, Any]:
        """The facts of a file, which its uploader calls `media_type`.

        Raises:
            MeasuringError: the file is unusable; `failure` says why.
            SlotError: nobody is there to measure it.
        """

    def ready(self) -> Readiness:
        """Whether work would be done."""

    def status(self) -> Status:
        """How it is, for people and meters."""

    def drain(self, timeout_seconds: float) -> None:
        """Take nothing new, finish what is running, and stop; the rest is done after the start."""
