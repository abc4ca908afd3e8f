"""From what callers ask for to work: that which is there already, or rows of new work."""

import uuid
from collections.abc import Callable, Collection, Iterable, Sequence
from dataclasses import dataclass
from typing import Any, Final

from sqlalchemy import Connection, Row, bindparam, insert, select

from worker.jobs.job import PRIORITIES, Priority
from worker.jobs.schema import work

IsReusable = Callable[[str, str | None], bool]
"""Whether the result of work, given its id and fingerprint, still serves."""

NEW_WORK: Final = insert(work)
_JOINABLE: Final = (
    select(work.c.id, work.c.digest, work.c.state, work.c.priority, work.c.fingerprint)
    .where(
        work.c.tenant == bindparam("tenant"),
        work.c.digest.in_(bindparam("digests", expanding=True)),
        work.c.state.in_(("queued", "running", "succeeded")),
    )
    .order_by(work.c.sequence)
)


@dataclass(frozen=True, slots=True)
class Request:
    """What a caller asks for; `estimate_seconds` is what the cost model expects on one core."""

    tenant: str
    kind: str
    body: dict[str, Any]
    digest: str
    priority: Priority
    time_limit_seconds: float
    estimate_seconds: float | None = None


def joinable(
    connection: Connection, tenant: str, digests: Collection[str], is_reusable: IsReusable
) -> dict[str, Row[Any]]:
    """By digest, the tenant's work that is under way or has a result that still serves."""
    parameters = {"tenant": tenant, "digests": list(digests)}
    rows: Sequence[Any] = connection.execute(_JOINABLE, parameters).all()
    newest = {row.digest: row for row in rows}
    return {
        digest: row
        for digest, row in newest.items()
        if row.state != "succeeded" or is_reusable(row.id, row.fingerprint)
    }


def new_work(requests: Iterable[Request], now: float, *, in_batch: bool) -> list[dict[str, Any]]:
    """The rows of work that nobody has begun, one for each request."""
    return [
        {
            "id": uuid.uuid4().hex,
            "tenant": request.tenant,
            "digest": request.digest,
            "kind": request.kind,
            "body": request.body,
            "priority": PRIORITIES.index(request.priority),
            "time_limit_seconds": request.time_limit_seconds,
            "estimate_seconds": request.estimate_seconds,
            "in_batch": in_batch,
            "state": "queued",
            "attempt": 0,
            "crashes": 0,
            "progress": 0.0,
            "created": now,
        }
        for request in requests
    ]
