"""The records of batches: many jobs, recorded and cancelled in one transaction."""

import time
import uuid
from collections.abc import Callable, Sequence
from typing import Any, Final

from sqlalchemy import Connection, Row, Select, case, func, insert, literal_column, select, update

from worker.jobs.batch import Batch, Entry, Item
from worker.jobs.database import Database
from worker.jobs.idempotency import Key, answered, remember
from worker.jobs.intake import IsReusable, Request, joinable, new_work
from worker.jobs.job import FINAL_STATES, PRIORITIES
from worker.jobs.requests import LARGEST_SEQUENCE
from worker.jobs.room import Room
from worker.jobs.schema import batch_items, batches, jobs, work


class Batches:
    """All batches of all tenants.

    Args:
        database: the records.
        room: how much may wait.
        is_reusable: whether the result of work, given its id and fingerprint, still serves.
        require_open: raises when nothing new is taken.
        arrived: called when there may be new work.
        unwanted: called with the id of work that jobs were taken from, maybe the last ones.
    """

    def __init__(
        self,
        database: Database,
        *,
        room: Room,
        is_reusable: IsReusable,
        require_open: Callable[[], None],
        arrived: Callable[[], None],
        unwanted: Callable[[str], None],
    ) -> None:
        self._database = database
        self._room = room
        self._is_reusable = is_reusable
        self._require_open = require_open
        self._arrived = arrived
        self._unwanted = unwanted

    def submit(self, tenant: str, items: Sequence[Item], key: Key | None = None) -> Batch:
        """Record a batch with a job for each item, or nothing at all.

        With a key that was sent before it answers the batch that was recorded then.

        Raises:
            DrainingError: the engine is stopping.
            QueueFullError: too much work of batches would be waiting.
            StorageFullError: the disk is full.
            KeyReusedError: the key came with another body before.
        """
        self._require_open()
        batch_id, now = uuid.uuid4().hex, time.time()
        with self._database.writing() as connection:
            if key is not None and (earlier := _replayed(connection, tenant, key)):
                return earlier
            work_ids = self._work(connection, tenant, items, now)
            connection.execute(
                insert(batches).values(id=batch_id, tenant=tenant, size=len(items), created=now)
            )
            job_ids = [uuid.uuid4().hex for _ in items]
            connection.execute(
                insert(jobs),
                [
                    {
                        "id": job_id,
                        "tenant": tenant,
                        "work_id": work_ids[item.request.digest],
                        "priority": PRIORITIES.index(item.request.priority),
                        "created": now,
                    }
                    for job_id, item in zip(job_ids, items, strict=True)
                ],
            )
            connection.execute(
                insert(batch_items),
                [
                    {"batch_id": batch_id, "place": place, "job_id": job_id, "values": item.values}
                    for place, (job_id, item) in enumerate(zip(job_ids, items, strict=True))
                ],
            )
            if key is not None:
                remember(connection, tenant, key, batch_id)
            batch = _one(connection, tenant, batch_id)
        self._arrived()
        return batch

    def replayed(self, tenant: str, key: Key) -> Batch | None:
        """The batch that a key stands for; None if it is new.

        Raises:
            KeyReusedError: the key came with another body before.
        """
        with self._database.reading() as connection:
            batch = _replayed(connection, tenant, key)
        if batch is not None:
            self._database.flush()  # whoever recorded it may not have come to that yet
        return batch

    def get(self, tenant: str, batch_id: str) -> Batch | None:
        """One batch of the tenant."""
        with self._database.reading() as connection:
            return _find(connection, tenant, batch_id)

    def page(
        self, tenant: str, *, cursor: str | None, limit: int
    ) -> tuple[list[Batch], str | None]:
        """Batches of the tenant, newest first, and the cursor of the next page if there is one."""
        query = select(batches).where(batches.c.tenant == tenant)
        if cursor is not None:
            query = query.where(batches.c.sequence < min(int(cursor, 16), LARGEST_SEQUENCE))
        newest = query.order_by(batches.c.sequence.desc()).limit(limit + 1)
        with self._database.reading() as connection:
            rows = connection.execute(newest).all()
            found = _summed_up(connection, rows[:limit])
        return found, f"{rows[limit - 1].sequence:016x}" if len(rows) > limit else None

    def entries(self, batch_id: str) -> list[Entry]:
        """What became of each item, in the order of the request."""
        query = _STATES.add_columns(
            batch_items.c.place,
            batch_items.c["values"],
            jobs.c.id,
            *(work.c[name] for name in ("kind", "digest", "failure", "facts")),
        )
        of_batch = query.where(batch_items.c.batch_id == batch_id).order_by(batch_items.c.place)
        with self._database.reading() as connection:
            return [
                Entry(
                    place=row.place,
                    values=row.values,
                    job_id=row.id,
                    kind=row.kind,
                    digest=row.digest,
                    state=row.state,
                    failure=row.failure if row.state == "failed" else None,
                    facts=row.facts if row.state == "succeeded" else None,
                )
                for row in connection.execute(of_batch)
            ]

    def cancel(self, tenant: str, batch_id: str) -> Batch | None:
        """Cancel the jobs that are not finished, and the work that no other job wants."""
        now = time.time()
        with self._database.writing() as connection:
            if _find(connection, tenant, batch_id) is None:
                return None
            live = (
                select(jobs.c.id, jobs.c.work_id)
                .join(batch_items, batch_items.c.job_id == jobs.c.id)
                .join(work, work.c.id == jobs.c.work_id)
                .where(
                    batch_items.c.batch_id == batch_id,
                    jobs.c.cancelled.is_(None),
                    work.c.state.in_(("queued", "running")),
                )
            )
            rows = connection.execute(live).all()
            touched = sorted({row.work_id for row in rows})
            connection.execute(
                update(jobs).where(jobs.c.id.in_([row.id for row in rows])).values(cancelled=now)
            )
            wanted = select(jobs.c.id).where(
                jobs.c.work_id == work.c.id, jobs.c.cancelled.is_(None)
            )
            connection.execute(
                update(work)
                .where(work.c.id.in_(touched), ~wanted.exists())
                .values(state="cancelled", stage=None, finished=now)
            )
            batch = _one(connection, tenant, batch_id)
        for work_id in touched:
            self._unwanted(work_id)
        return batch

    def _work(
        self, connection: Connection, tenant: str, items: Sequence[Item], now: float
    ) -> dict[str, str]:
        """The id of the work behind each digest: joined, or new."""
        wanted: dict[str, Request] = {}
        for item in items:  # equal items share their work, at the urgency of the most urgent one
            known = wanted.setdefault(item.request.digest, item.request)
            if PRIORITIES.index(item.request.priority) < PRIORITIES.index(known.priority):
                wanted[item.request.digest] = item.request
        there = joinable(connection, tenant, list(wanted), self._is_reusable)
        for digest, row in there.items():
            urgency = PRIORITIES.index(wanted[digest].priority)
            if row.state != "succeeded" and urgency < row.priority:
                hurried = update(work).where(work.c.id == row.id).values(priority=urgency)
                connection.execute(hurried)
        missing = [request for digest, request in wanted.items() if digest not in there]
        self._room.require_for_batch(connection, len(missing))
        rows = new_work(missing, now, in_batch=True)
        if rows:
            connection.execute(insert(work), rows)
        return {digest: row.id for digest, row in there.items()} | {
            row["digest"]: row["id"] for row in rows
        }


_CANCELLED: Final = jobs.c.cancelled.is_not(None)
_STATE: Final = case((_CANCELLED, literal_column("'cancelled'")), else_=work.c.state)
_ENDED: Final = case((_CANCELLED, jobs.c.cancelled), else_=work.c.finished)
_STATES: Final[Select[Any]] = (
    select(batch_items.c.batch_id, _STATE.label("state"))
    .join(jobs, jobs.c.id == batch_items.c.job_id)
    .join(work, work.c.id == jobs.c.work_id)
)


def _replayed(connection: Connection, tenant: str, key: Key) -> Batch | None:
    batch_id = answered(connection, tenant, key)
    return None if batch_id is None else _find(connection, tenant, batch_id)


def _find(connection: Connection, tenant: str, batch_id: str) -> Batch | None:
    is_this = (batches.c.tenant == tenant, batches.c.id == batch_id)
    found = _summed_up(connection, connection.execute(select(batches).where(*is_this)).all())
    return found[0] if found else None


def _one(connection: Connection, tenant: str, batch_id: str) -> Batch:
    batch = _find(connection, tenant, batch_id)
    assert batch is not None
    return batch


def _summed_up(connection: Connection, rows: Sequence[Row[Any]]) -> list[Batch]:
    """The batches of some rows, with what became of their items."""
    ids = [row.id for row in rows]
    sums = _STATES.add_columns(
        func.count().label("jobs"),
        func.sum(work.c.progress).label("progress"),
        func.max(_ENDED).label("ended"),
    )
    by_state = sums.where(batch_items.c.batch_id.in_(ids)).group_by(batch_items.c.batch_id, _STATE)
    parts: dict[str, list[Row[Any]]] = {batch_id: [] for batch_id in ids}
    for part in connection.execute(by_state):
        parts[part.batch_id].append(part)
    return [_batch(row, parts[row.id]) for row in rows]


def _batch(row: Row[Any], parts: Sequence[Row[Any]]) -> Batch:
    over = [part for part in parts if part.state in FINAL_STATES]
    under_way = [part for part in parts if part.state not in FINAL_STATES]
    done = sum(part.jobs for part in over) + sum(part.progress for part in under_way)
    # What had been made before the batch came was there when it came.
    ended = max([row.created, *(part.ended for part in over)])
    return Batch(
        id=row.id,
        tenant=row.tenant,
        size=row.size,
        created=row.created,
        counts={part.state: part.jobs for part in parts},
        progress=done / row.size,
        finished=None if under_way else ended,
    )
