"""The engine's side of the records: claim work, tell how it goes, settle how it ended.

Every change names the attempt it belongs to and is refused when the work has moved on: what a child
did for cancelled or repeated work can do no harm, however late it comes.
"""

import time
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, Final

from sqlalchemy import Connection, func, select, update

from worker.errors import Failure
from worker.jobs.database import Database
from worker.jobs.errors import failure
from worker.jobs.schema import work

MOST_CRASHES: Final = 3
# A service may well be killed in the middle of a job, but not by the same job again and again.
MOST_ATTEMPTS: Final = 10


@dataclass(frozen=True, slots=True)
class Claim:
    """Work that somebody does right now; `attempt` is the fence."""

    work_id: str
    attempt: int
    tenant: str
    digest: str
    kind: str
    body: dict[str, Any]
    time_limit_seconds: float


class Claims:
    """Who does what."""

    def __init__(self, database: Database) -> None:
        self._database = database

    def recover(self) -> None:
        """Put back what was running when the service ended."""
        lost = failure("worker_lost", f"the service ended {MOST_ATTEMPTS} times at this work")
        running = work.c.state == "running"
        hopeless = _ended("failed") | {"failure": lost}
        with self._database.writing() as connection:
            connection.execute(
                update(work).where(running, work.c.attempt >= MOST_ATTEMPTS).values(hopeless)
            )
            connection.execute(update(work).where(running).values(_WAITING))

    def claim(self) -> Claim | None:
        """Take the next work: interactive before batch, else first come, first served."""
        with self._database.writing(durably=False) as connection:
            row = connection.execute(_NEXT_IN_LINE).first()
            if row is None:
                return None
            attempt = row.attempt + 1
            connection.execute(
                update(work)
                .where(work.c.id == row.id)
                .values(state="running", attempt=attempt, started=time.time())
            )
        return Claim(
            row.id, attempt, row.tenant, row.digest, row.kind, row.body, row.time_limit_seconds
        )

    def report(self, claim: Claim, progress: float, stage: str) -> None:
        """Tell how far the work is."""
        news = {"progress": min(max(progress, 0.0), 1.0), "stage": stage[:64]}
        with self._database.writing(durably=False) as connection:
            _change(connection, claim, news)

    def succeed(
        self,
        claim: Claim,
        facts: dict[str, Any],
        fingerprint: str | None,
        publish: Callable[[], None],
    ) -> bool:
        """Record success and publish the result inside the fence; False when it came too late."""
        success = _ended("succeeded") | {
            "facts": facts,
            "fingerprint": fingerprint,
            "progress": 1.0,
        }
        with self._database.writing() as connection:
            accepted = _change(connection, claim, success)
            if accepted:
                publish()
        return accepted

    def fail(self, claim: Claim, why: Failure) -> None:
        """Record a failure that another attempt would only repeat."""
        with self._database.writing() as connection:
            _change(connection, claim, _ended("failed") | {"failure": why})

    def crash(self, claim: Claim, why: Failure) -> None:
        """Put work back whose worker died; after the third time it has failed."""
        is_this = work.c.id == claim.work_id
        with self._database.writing() as connection:
            crashes = 1 + connection.execute(select(work.c.crashes).where(is_this)).scalar_one()
            end = _WAITING if crashes < MOST_CRASHES else _ended("failed") | {"failure": why}
            _change(connection, claim, end | {"crashes": crashes})

    def put_back(self, claim: Claim) -> None:
        """Return work that nobody has time for any more; cancelled work stays cancelled."""
        with self._database.writing() as connection:
            _change(connection, claim, _WAITING)

    def is_live(self, work_id: str) -> bool:
        """Whether the work is still to be done."""
        query = select(work.c.id).where(
            work.c.id == work_id, work.c.state.in_(("queued", "running"))
        )
        with self._database.reading() as connection:
            return connection.execute(query).first() is not None

    def counts(self) -> dict[str, int]:
        """How much work there is in each state."""
        with self._database.reading() as connection:
            rows = connection.execute(select(work.c.state, func.count()).group_by(work.c.state))
            return {row[0]: row[1] for row in rows}


_NEXT_IN_LINE: Final = (
    select(work).where(work.c.state == "queued").order_by(work.c.priority, work.c.sequence).limit(1)
)
_WAITING: Final[dict[str, Any]] = {
    "state": "queued",
    "progress": 0.0,
    "stage": None,
    "started": None,
}


def _ended(state: str) -> dict[str, Any]:
    return {"state": state, "stage": None, "finished": time.time()}


def _change(connection: Connection, claim: Claim, values: dict[str, Any]) -> bool:
    """Change claimed work if it is still this attempt that runs."""
    changed = connection.execute(
        update(work)
        .where(
            work.c.id == claim.work_id,
            work.c.attempt == claim.attempt,
            work.c.state == "running",
        )
        .values(values)
    )
    return changed.rowcount == 1
