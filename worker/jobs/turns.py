"""Whose work comes next: the urgent before the rest, and in each the tenants in turn."""

import threading
from typing import Final

from sqlalchemy import Connection, func, select

from worker.jobs.job import PRIORITIES
from worker.jobs.schema import work

INTERACTIVE, BATCH = (PRIORITIES.index(name) for name in ("interactive", "batch"))
SLOTS_TO_KEEP_ONE_FREE: Final = 3


def slots_for(priority: int, slots: int) -> int:
    """How many slots work of a priority may hold at a time.

    Of three or more, batch leaves one to whoever waits in front of a screen.
    """
    return slots - 1 if priority == BATCH and slots >= SLOTS_TO_KEEP_ONE_FREE else slots


class Turns:
    """Gives every tenant the same share of the slots, however much each has waiting.

    The next in turn is the tenant with the least work running, among these the one served least
    recently, and of it what came first.
    """

    def __init__(self, slots: int) -> None:
        self._slots = slots
        self._lock = threading.Lock()
        self._served: dict[str, int] = {}
        self._count = 0

    def next(self, connection: Connection) -> int | None:
        """The sequence number of the work to be done next; None when none may begin."""
        waiting: dict[int, dict[str, int]] = {INTERACTIVE: {}, BATCH: {}}
        running = dict.fromkeys(waiting, 0)
        of_tenant: dict[str, int] = {}
        for state, priority, tenant, count, first in connection.execute(_HEADS):
            if state == "queued":
                waiting[priority][tenant] = first
            else:
                running[priority] += count
                of_tenant[tenant] = of_tenant.get(tenant, 0) + count
        with self._lock:
            for priority, heads in waiting.items():
                if heads and self._may_begin(priority, running[priority]):
                    tenant = min(
                        heads,
                        key=lambda one: (
                            of_tenant.get(one, 0),
                            self._served.get(one, 0),
                            heads[one],
                        ),
                    )
                    self._serve(tenant, waiting)
                    return heads[tenant]
        return None

    def _may_begin(self, priority: int, running: int) -> bool:
        kept = slots_for(priority, self._slots)
        return kept == self._slots or running < kept

    def _serve(self, tenant: str, waiting: dict[int, dict[str, int]]) -> None:
        """Remember who was served, and forget those who have nothing waiting any more."""
        self._count += 1
        here = waiting[INTERACTIVE].keys() | waiting[BATCH].keys()
        self._served = {name: turn for name, turn in self._served.items() if name in here}
        self._served[tenant] = self._count


_HEADS: Final = (
    select(
        work.c.state,
        work.c.priority,
        work.c.tenant,
        func.count(),
        func.min(work.c.sequence),
    )
    .where(work.c.state.in_(("queued", "running")))
    .group_by(work.c.state, work.c.priority, work.c.tenant)
)
