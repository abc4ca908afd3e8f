"""The callers' side of the records: submit, look, list and cancel jobs."""

import math
import time
import uuid
from collections.abc import Collection
from typing import Any, Final

from sqlalchemy import Connection, Row, Select, and_, case, func, insert, or_, select, update

from worker.jobs.database import Database
from worker.jobs.errors import QueueFullError
from worker.jobs.idempotency import Key, answered, remember
from worker.jobs.intake import IsReusable, Request, joinable, new_work
from worker.jobs.job import PRIORITIES, Job, State
from worker.jobs.schema import jobs, work

RECENT: Final = 32
MOST_IDS: Final = 1000
"""In one question: SQLite takes 32766 parameters."""
LARGEST_SEQUENCE: Final = 2**63 - 1


class Requests:
    """All jobs of all tenants.

    Args:
        database: the records.
        queue_limit: how much work may wait.
        slots: how much work is done at a time.
        is_reusable: whether the result of work, given its id and fingerprint, still serves.
    """

    def __init__(
        self,
        database: Database,
        *,
        queue_limit: int,
        slots: int,
        is_reusable: IsReusable,
    ) -> None:
        self._database = database
        self._queue_limit = queue_limit
        self._slots = slots
        self._is_reusable = is_reusable

    def submit(self, request: Request, key: Key | None = None) -> Job:
        """Record a job, joined to work that is under way or done, or else to new work.

        With a key that was sent before it answers the job that was recorded then.

        Raises:
            QueueFullError: it would be new work, and too much is waiting.
            KeyReusedError: the key came with another body before.
        """
        job_id, now = uuid.uuid4().hex, time.time()
        with self._database.writing() as connection:
            if key is not None and (earlier := _replayed(connection, request.tenant, key)):
                return earlier
            work_id = self._joinable(connection, request)
            if work_id is None:
                self._require_room(connection)
                [new] = new_work([request], now, in_batch=False)
                connection.execute(insert(work), new)
                work_id = new["id"]
            connection.execute(
                insert(jobs).values(
                    id=job_id,
                    tenant=request.tenant,
                    work_id=work_id,
                    priority=PRIORITIES.index(request.priority),
                    created=now,
                )
            )
            if key is not None:
                remember(connection, request.tenant, key, job_id)
            row = connection.execute(_JOBS.where(jobs.c.id == job_id)).one()
        return _job(row)

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
                found += map(_job, connection.execute(_JOBS.where(some)))
        return {job.id: job for job in found}

    def get(self, tenant: str, job_id: str) -> Job | None:
        """One job of the tenant."""
        query = _JOBS.where(jobs.c.tenant == tenant, jobs.c.id == job_id)
        with self._database.reading() as connection:
            row = connection.execute(query).first()
        return None if row is None else _job(row)

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
        page = rows[:limit]
        more = f"{page[-1].job_sequence:016x}" if page and len(rows) > limit else None
        return [_job(row) for row in page], more

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
            row = connection.execute(_JOBS.where(is_this)).one()
        return _job(row)

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

    def _require_room(self, connection: Connection) -> None:
        waiting = connection.execute(
            select(func.count())
            .select_from(work)
            .where(work.c.state == "queued", work.c.in_batch.is_(False))
        ).scalar_one()
        if waiting >= self._queue_limit:
            seconds_each = seconds_of_recent_work(connection)
            raise QueueFullError(waiting, max(1, math.ceil(seconds_each / self._slots)))


def seconds_of_recent_work(connection: Connection) -> float:
    """Mean run time of what finished last; if nothing did, how long something has been running."""
    ran = (
        select((work.c.finished - work.c.started).label("seconds"))
        .where(work.c.state == "succeeded")
        .order_by(work.c.sequence.desc())
        .limit(RECENT)
        .subquery()
    )
    mean = connection.execute(select(func.avg(ran.c.seconds))).scalar()
    if mean is None:
        running = select(func.max(time.time() - work.c.started)).where(work.c.state == "running")
        mean = connection.execute(running).scalar()
    return float(mean or 0.0)


def _replayed(connection: Connection, tenant: str, key: Key) -> Job | None:
    job_id = answered(connection, tenant, key)
    row = connection.execute(_JOBS.where(jobs.c.tenant == tenant, jobs.c.id == job_id)).first()
    return None if row is None else _job(row)


def _jobs_with_work() -> Select[Any]:
    """Everything a `Job` tells, one row for each."""
    ahead = work.alias("ahead")
    is_ahead = or_(
        ahead.c.priority < work.c.priority,
        and_(ahead.c.priority == work.c.priority, ahead.c.sequence < work.c.sequence),
    )
    in_front = (
        select(func.count())
        .select_from(ahead)
        .where(ahead.c.state == "queued", is_ahead)
        .correlate(work)
        .scalar_subquery()
    )
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
        case((work.c.state == "queued", in_front)).label("in_front"),
    ).join(work, work.c.id == jobs.c.work_id)


_JOBS: Final = _jobs_with_work()


def _job(row: Row[Any]) -> Job:
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
        position=row.in_front + 1 if state == "queued" else None,
        estimate_seconds=row.estimate_seconds,
        work_id=row.work_id,
    )
