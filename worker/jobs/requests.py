"""The callers' side of the records: submit, look, list and cancel jobs."""

import time
import uuid
from collections.abc import Collection, Sequence
from typing import Any, Final

from sqlalchemy import Connection, Row, Select, and_, bindparam, func, insert, select, update

from worker.jobs.database import Database
from worker.jobs.idempotency import Key, answered, remember
from worker.jobs.intake import NEW_WORK, IsReusable, Request, joinable, new_work
from worker.jobs.job import PRIORITIES, Job, State
from worker.jobs.meters import Found, Meters
from worker.jobs.room import Room
from worker.jobs.schema import jobs, work

MOST_IDS: Final = 1000
"""In one question: SQLite takes 32766 parameters."""
LARGEST_SEQUENCE: Final = 2**63 - 1


class Requests:
    """All jobs of all tenants.

    Args:
        database: the records.
        room: how much may wait.
        meters: hear what was accepted.
        is_reusable: whether the result of work, given its id and fingerprint, still serves.
    """

    def __init__(
        self,
        database: Database,
        *,
        room: Room,
        meters: Meters,
        is_reusable: IsReusable,
    ) -> None:
        self._database = database
        self._room = room
        self._meters = meters
        self._is_reusable = is_reusable

    def submit(self, request: Request, key: Key | None = None) -> Job:
        """Record a job, joined to work that is under way or done, or else to new work.

        With a key that was sent before it answers the job that was recorded then. The caller
        flushes the records before it promises anything.

        Raises:
            QueueFullError: it would be new work, and too much is waiting.
            KeyReusedError: the key came with another body before.
        """
        job_id, now = uuid.uuid4().hex, time.time()
        with self._database.writing(durably=False) as connection:
            if key is not None and (earlier := _replayed(connection, request.tenant, key)):
                return earlier
            work_id = self._joinable(connection, request)
            is_new = work_id is None
            if work_id is None:
                self._room.require(connection, request.tenant, request.priority)
                [new] = new_work([request], now, in_batch=False)
                connection.execute(NEW_WORK, new)
                work_id = new["id"]
            connection.execute(
                _NEW_JOB,
                {
                    "id": job_id,
                    "tenant": request.tenant,
                    "work_id": work_id,
                    "priority": PRIORITIES.index(request.priority),
                    "created": now,
                },
            )
            if key is not None:
                remember(connection, request.tenant, key, job_id)
            [job] = _found(connection, _BY_ID, tenant=request.tenant, job_id=job_id)
        found: Found = "new" if is_new else "finished" if job.state == "succeeded" else "shared"
        self._meters.submitted(request.priority, found)
        return job

    def replayed(self, tenant: str, key: Key) -> Job | None:
        """The job that a key stands for; None if it is new.

        Raises:
            KeyReusedError: the key came with another body before.
        """
        with self._database.reading() as connection:
            return _replayed(connection, tenant, key)

    def look(self, job_ids: Collection[str]) -> dict[str, Job]:
        """Those of the jobs that exist, of whatever tenant, by id."""
        ids, found = list(job_ids), list[Job]()
        with self._database.reading() as connection:
            for first in range(0, len(ids), MOST_IDS):
                some = jobs.c.id.in_(ids[first : first + MOST_IDS])
                found += _found(connection, _JOBS.where(some))
        return {job.id: job for job in found}

    def get(self, tenant: str, job_id: str) -> Job | None:
        """One job of the tenant."""
        with self._database.reading() as connection:
            found = _found(connection, _BY_ID, tenant=tenant, job_id=job_id)
        return found[0] if found else None

    def list(
        self, tenant: str, *, cursor: str | None, limit: int, state: str | None
    ) -> tuple[list[Job], str | None]:
        """Jobs of the tenant, newest first, and the cursor of the next page if there is one.

        Raises:
            ValueError: the cursor is not hexadecimal.
        """
        query = _JOBS.where(jobs.c.tenant == tenant)
        if cursor is not None:
            query = query.where(jobs.c.sequence < min(int(cursor, 16), LARGEST_SEQUENCE))
        if state == "cancelled":
            query = query.where(jobs.c.cancelled.is_not(None))
        elif state is not None:
            query = query.where(jobs.c.cancelled.is_(None), work.c.state == state)
        with self._database.reading() as connection:
            rows = connection.execute(query.order_by(jobs.c.sequence.desc()).limit(limit + 1)).all()
            page = _jobs_of(connection, rows[:limit])
        more = f"{rows[limit - 1].job_sequence:016x}" if len(rows) > limit else None
        return page, more

    def cancel(self, tenant: str, job_id: str) -> Job | None:
        """Cancel a job that is not finished, and its work unless another job wants it."""
        is_this = and_(jobs.c.tenant == tenant, jobs.c.id == job_id)
        now = time.time()
        with self._database.writing() as connection:
            row = connection.execute(_JOBS.where(is_this)).first()
            if row is None:
                return None
            if row.cancelled is None and row.state in ("queued", "running"):
                connection.execute(update(jobs).where(is_this).values(cancelled=now))
                wanted = select(jobs.c.id).where(
                    jobs.c.work_id == row.work_id, jobs.c.cancelled.is_(None)
                )
                if connection.execute(wanted.limit(1)).first() is None:
                    connection.execute(
                        update(work)
                        .where(work.c.id == row.work_id)
                        .values(state="cancelled", stage=None, finished=now)
                    )
            [job] = _found(connection, _JOBS.where(is_this))
        return job

    def _joinable(self, connection: Connection, request: Request) -> str | None:
        """The id of work of the same tenant and digest that is under way or has a good result."""
        found = joinable(connection, request.tenant, [request.digest], self._is_reusable)
        newest = found.get(request.digest)
        if newest is None:
            return None
        urgency = PRIORITIES.index(request.priority)
        if newest.state != "succeeded" and urgency < newest.priority:
            connection.execute(update(work).where(work.c.id == newest.id).values(priority=urgency))
        return str(newest.id)


def _replayed(connection: Connection, tenant: str, key: Key) -> Job | None:
    job_id = answered(connection, tenant, key)
    found = _found(connection, _BY_ID, tenant=tenant, job_id=job_id)
    return found[0] if found else None


def _jobs_with_work() -> Select[Any]:
    """Everything a `Job` tells, one row for each."""
    return select(
        jobs.c.sequence.label("job_sequence"),
        jobs.c.id,
        jobs.c.tenant,
        jobs.c.priority,
        jobs.c.created,
        jobs.c.cancelled,
        jobs.c.work_id,
        *(work.c[name] for name in ("kind", "digest", "state", "attempt", "progress", "stage")),
        *(work.c[name] for name in ("started", "finished", "failure", "facts")),
        work.c.estimate_seconds,
    ).join(work, work.c.id == jobs.c.work_id)


def _line() -> Select[Any]:
    """Waiting work with its place: by priority, and in each the tenants in turn."""
    turn = func.row_number().over(
        partition_by=(work.c.priority, work.c.tenant), order_by=work.c.sequence
    )
    waiting = (
        select(work.c.id, work.c.priority, work.c.sequence, turn.label("turn"))
        .where(work.c.state == "queued")
        .subquery()
    )
    place = func.row_number().over(
        order_by=(waiting.c.priority, waiting.c.turn, waiting.c.sequence)
    )
    return select(waiting.c.id, place.label("place"))


_JOBS: Final = _jobs_with_work()
_LINE: Final = _line().subquery()

# Made once: to put a statement together costs as much as to execute it.
_NEW_JOB: Final = insert(jobs)
_BY_ID: Final = _JOBS.where(jobs.c.tenant == bindparam("tenant"), jobs.c.id == bindparam("job_id"))
_PLACES: Final = select(_LINE.c.id, _LINE.c.place).where(
    _LINE.c.id.in_(bindparam("ids", expanding=True))
)


def _found(connection: Connection, query: Select[Any], **parameters: str | None) -> list[Job]:
    return _jobs_of(connection, connection.execute(query, parameters).all())


def _jobs_of(connection: Connection, rows: Sequence[Row[Any]]) -> list[Job]:
    """The jobs of some rows, with their places in the queue."""
    waiting = list({row.work_id for row in rows if row.state == "queued"})
    places: dict[str, int] = {}
    if waiting:
        found = connection.execute(_PLACES, {"ids": waiting})
        places = {row.id: row.place for row in found}
    return [_job(row, places.get(row.work_id)) for row in rows]


def _job(row: Row[Any], place: int | None) -> Job:
    state: State = row.state if row.cancelled is None else "cancelled"
    return Job(
        id=row.id,
        tenant=row.tenant,
        kind=row.kind,
        priority=PRIORITIES[row.priority],
        digest=row.digest,
        state=state,
        attempt=row.attempt,
        progress=row.progress,
        stage=row.stage if state == "running" else None,
        created=row.created,
        started=row.started,
        finished=row.finished if row.cancelled is None else row.cancelled,
        failure=row.failure if state == "failed" else None,
        facts=row.facts if state == "succeeded" else None,
        position=place if state == "queued" else None,
        estimate_seconds=row.estimate_seconds,
        work_id=row.work_id,
    )
