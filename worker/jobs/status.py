"""How the engine is, at one moment: what people and meters are told."""

import time
from collections.abc import Mapping
from dataclasses import dataclass

from sqlalchemy import func, select

from worker.jobs.database import Database
from worker.jobs.job import PRIORITIES, Priority
from worker.jobs.schema import work


@dataclass(frozen=True, slots=True)
class Readiness:
    """Whether work would be done; `fingerprint` is there once a child is warm."""

    slots: int
    warm_slots: int
    fingerprint: str | None
    draining: bool
    queued: int
    running: int


@dataclass(frozen=True, slots=True)
class QueueStatus:
    """The work of one priority; `oldest_seconds` is how long the first in line has waited."""

    queued: int
    running: int
    oldest_seconds: float


@dataclass(frozen=True, slots=True)
class SlotStatus:
    """One slot; `technique`, `attempt` and `seconds` are of what it is doing, if anything."""

    name: str
    is_warm: bool
    jobs_done: int
    technique: str | None
    attempt: int | None
    seconds: float | None


@dataclass(frozen=True, slots=True)
class StoreStatus:
    """What the files take, and what is free on their disk."""

    result_bytes: int
    results: int
    asset_bytes: int
    free_bytes: int


@dataclass(frozen=True, slots=True)
class Status:
    """Everything; `fingerprint` names the platform of the children, once one is warm."""

    draining: bool
    uptime_seconds: float
    fingerprint: str | None
    typical_seconds: float
    queues: Mapping[Priority, QueueStatus]
    slots: tuple[SlotStatus, ...]
    store: StoreStatus


def queues(database: Database) -> dict[Priority, QueueStatus]:
    """The waiting and the running work of each priority."""
    query = (
        select(work.c.state, work.c.priority, func.count(), func.min(work.c.created))
        .where(work.c.state.in_(("queued", "running")))
        .group_by(work.c.state, work.c.priority)
    )
    with database.reading() as connection:
        found = {(row[0], row[1]): (row[2], row[3]) for row in connection.execute(query)}
    now = time.time()
    answer: dict[Priority, QueueStatus] = {}
    for number, name in enumerate(PRIORITIES):
        queued, since = found.get(("queued", number), (0, now))
        running, _ = found.get(("running", number), (0, now))
        answer[name] = QueueStatus(queued, running, max(0.0, now - since))
    return answer
