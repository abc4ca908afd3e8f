"""How much may wait, and when to come back where that is too much.

Batches have a bound of their own and do not count: who sent one may still ask for a picture.
"""

import math
from typing import Final

from sqlalchemy import Connection, func, select

from worker.jobs.errors import QueueFullError, TenantFullError
from worker.jobs.job import PRIORITIES, Priority
from worker.jobs.meters import Meters
from worker.jobs.run_times import RunTimes
from worker.jobs.schema import work
from worker.jobs.turns import BATCH, slots_for

IN_BATCHES: Final = 4000
"""Work of batches that may wait: it does not count as waiting for those who ask for one thing."""

_WAITING: Final = (
    select(work.c.tenant, func.count())
    .where(work.c.state == "queued", work.c.in_batch.is_(False))
    .group_by(work.c.tenant)
)


class Room:
    """The bounds of the queue.

    Args:
        queue_limit: how much work may wait.
        tenant_limit: how much of it may be one tenant's.
        slots: how much work is done at a time.
        run_times: how long it takes.
        meters: hear what was refused.
    """

    def __init__(
        self,
        *,
        queue_limit: int,
        tenant_limit: int,
        slots: int,
        run_times: RunTimes,
        meters: Meters,
    ) -> None:
        self._queue_limit = queue_limit
        self._tenant_limit = tenant_limit
        self._slots = slots
        self._run_times = run_times
        self._meters = meters

    def require(self, connection: Connection, tenant: str, priority: Priority) -> None:
        """Refuse more work than may wait.

        Raises:
            TenantFullError: too much of this tenant is waiting.
            QueueFullError: too much is waiting altogether.
        """
        waiting = {row[0]: row[1] for row in connection.execute(_WAITING)}
        slots = slots_for(PRIORITIES.index(priority), self._slots)
        # A place becomes free when work begins, which is when other work ends.
        seconds = self._run_times.typical() / slots
        if waiting.get(tenant, 0) >= self._tenant_limit:
            self._meters.refused("tenant_queue_full", 1)
            # Tenants take turns, so one of its own begins only every so many times.
            raise TenantFullError(waiting.get(tenant, 0), _whole(seconds * max(1, len(waiting))))
        if (everything := sum(waiting.values())) >= self._queue_limit:
            self._meters.refused("queue_full", 1)
            raise QueueFullError(everything, _whole(seconds))

    def require_for_batch(self, connection: Connection, count: int) -> None:
        """Refuse more work of batches than may wait.

        Raises:
            QueueFullError: so much more is too much.
        """
        query = select(func.count()).where(work.c.state == "queued", work.c.in_batch.is_(True))
        waiting = connection.execute(query).scalar_one()
        excess = waiting + count - IN_BATCHES
        if count and excess > 0:
            seconds = excess * self._run_times.typical() / slots_for(BATCH, self._slots)
            self._meters.refused("batches_full", count)
            raise QueueFullError(waiting, _whole(seconds))


def _whole(seconds: float) -> int:
    return max(1, math.ceil(seconds))
