"""The engine's side of the records: claim work, tell how it goes, settle how it ended.

Every change names the attempt it belongs to and is refused when the work has moved on: what a child
did for cancelled or repeated work can do no harm, however late it comes. None of them is flushed: a
power cut that undoes one has the work done again, to the same bytes.
"""

import time
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, Final

from sqlalchemy import Connection, bindparam, func, select, update

from worker.errors import Failure
from worker.jobs.database import Database
from worker.jobs.errors import failure
from worker.jobs.job import PRIORITIES, Priority
from worker.jobs.schema import work
from worker.jobs.turns import Turns

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
    priority: Priority
    waited_seconds: float


class Claims:
    """Who does what.

    Args:
        database: the records.
        slots: how much work is done at a time.
    """

    def __init__(self, database: Database, slots: int = 1) -> None:
        self._database = database
        self._turns = Turns(slots)

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
        """Take the work whose turn it is."""
        with self._database.writing(durably=False) as connection:
            sequence = self._turns.next(connection)
            if sequence is None:
                return None
            row = connection.execute(_ROW, {"this": sequence}).one()
            attempt, now = row.attempt + 1, time.time()
            taken = {"this": sequence, "state": "running", "attempt": attempt, "started": now}
            connection.execute(_TAKE, taken)
        return Claim(
            work_id=row.id,
            attempt=attempt,
            tenant=row.tenant,
            digest=row.digest,
            kind=row.kind,
            body=row.body,
            time_limit_seconds=row.time_limit_seconds,
            priority=PRIORITIES[row.priority],
            waited_seconds=max(0.0, now - row.created),
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
        """Record success and publish the result inside the fence; False when it came too late.

        The file is to be on the disk already, since any later flush takes the record there.
        """
        success = _ended("succeeded") | {
            "facts": facts,
            "fingerprint": fingerprint,
            "progress": 1.0,
            "evicted": None,
        }
        with self._database.writing(durably=False) as connection:
            accepted = _change(connection, claim, success)
            if accepted:
                publish()
        return accepted

    def fail(self, claim: Claim, why: Failure) -> None:
        """Record a failure that another attempt would only repeat."""
        with self._database.writing(durably=False) as connection:
            _change(connection, claim, _ended("failed") | {"failure": why})

    def crash(self, claim: Claim, why: Failure) -> None:
        """Put work back whose worker died; after the third time it has failed."""
        is_this = work.c.id == claim.work_id
        with self._database.writing(durably=False) as connection:
            crashes = 1 + connection.execute(select(work.c.crashes).where(is_this)).scalar_one()
            end = _WAITING if crashes < MOST_CRASHES else _ended("failed") | {"failure": why}
            _change(connection, claim, end | {"crashes": crashes})

    def put_back(self, claim: Claim) -> None:
        """Return work that nobody has time for any more; cancelled work stays cancelled."""
        with self._database.writing(durably=False) as connection:
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


# Made once: to put a statement together costs as much as to execute it.
_ROW: Final = select(work).where(work.c.sequence == bindparam("this"))
_TAKE: Final = update(work).where(work.c.sequence == bindparam("this"))
_CURRENT: Final = update(work).where(
    work.c.id == bindparam("this"),
    work.c.attempt == bindparam("this_attempt"),
    work.c.state == "running",
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
    this = {"this": claim.work_id, "this_attempt": claim.attempt}
    return connection.execute(_CURRENT, this | values).rowcount == 1
