"""How long work takes here, measured: what an honest Retry-After is made of."""

import threading
import time
from collections import deque
from typing import Final

from sqlalchemy import select

from worker.jobs.database import Database
from worker.jobs.schema import work

RECENT: Final = 32


class RunTimes:
    """The run times of the work that ended last, in seconds of a clock that never jumps."""

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._recent: deque[float] = deque(maxlen=RECENT)
        self._begun: dict[str, float] = {}

    def recall(self, database: Database) -> None:
        """Take over from the records what was measured before the last start."""
        query = (
            select(work.c.finished - work.c.started)
            .where(work.c.state == "succeeded", work.c.finished >= work.c.started)
            .order_by(work.c.sequence.desc())
            .limit(RECENT)
        )
        with database.reading() as connection:
            remembered = list(connection.execute(query).scalars())
        with self._lock:
            self._recent.extendleft(remembered)

    def begin(self, work_id: str) -> None:
        """Start the watch of some work."""
        with self._lock:
            self._begun[work_id] = time.monotonic()

    def end(self, work_id: str, *, counts: bool) -> float:
        """Stop the watch, and tell how long the work took; cancelled work tells nothing."""
        with self._lock:
            seconds = time.monotonic() - self._begun.pop(work_id)
            if counts:
                self._recent.append(seconds)
        return seconds

    def typical(self) -> float:
        """The mean; while nothing has ended yet, how long something has been running."""
        with self._lock:
            if self._recent:
                return sum(self._recent) / len(self._recent)
            now = time.monotonic()
            return max((now - begun for begun in self._begun.values()), default=0.0)
