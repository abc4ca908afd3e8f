"""When a job will be finished, from how long the last work of its kind took."""

import threading
import time
from dataclasses import dataclass
from typing import Final

from sqlalchemy import select

from worker.jobs.database import Database
from worker.jobs.job import FINAL_STATES, Job
from worker.jobs.schema import work

RECENT: Final = 32
FRESH_SECONDS: Final = 1.0


@dataclass(frozen=True, slots=True)
class History:
    """Mean run time of recent work, and how many times its estimate that was, if it had one."""

    mean_seconds: float
    ratio: float | None

    def expect(self, estimate_seconds: float | None) -> float:
        """Seconds that work of an estimate will take."""
        if estimate_seconds is None or self.ratio is None:
            return self.mean_seconds
        return self.ratio * estimate_seconds


class Forecast:
    """What the records tell about the time to come; looked up at most once a second.

    Args:
        database: the records.
        slots: how much work is done at a time.
    """

    def __init__(self, database: Database, slots: int) -> None:
        self._database = database
        self._slots = slots
        self._looking = threading.Lock()
        self._known: dict[str, tuple[float, History | None]] = {}

    def seconds_left(self, job: Job) -> float | None:
        """Seconds until a job is finished; None when it is, and without history.

        The place of the first in line comes free, on average, after the mean run time divided by
        the number of slots, and that of the next one after twice that time. Work that takes longer
        than expected is judged by its own progress from then on.
        """
        history = None if job.state in FINAL_STATES else self._history(job.kind)
        if history is None:
            return None
        expected = history.expect(job.estimate_seconds)
        if job.position is not None:
            return job.position * history.mean_seconds / self._slots + expected
        ran = max(0.0, time.time() - (job.started or time.time()))
        if ran < expected:
            return expected - ran
        return ran * (1 - job.progress) / job.progress if job.progress > 0 else None

    def _history(self, kind: str) -> History | None:
        with self._looking:
            now = time.monotonic()
            looked, found = self._known.get(kind, (-FRESH_SECONDS, None))
            if now - looked >= FRESH_SECONDS:
                found = self._look(kind)
                self._known[kind] = (now, found)
            return found

    def _look(self, kind: str) -> History | None:
        recent = (
            select(work.c.started, work.c.finished, work.c.estimate_seconds)
            .where(work.c.state == "succeeded", work.c.kind == kind)
            .order_by(work.c.sequence.desc())
            .limit(RECENT)
        )
        with self._database.reading() as connection:
            rows = connection.execute(recent).all()
        if not rows:
            return None
        ran = [max(0.0, row.finished - row.started) for row in rows]
        estimated = [
            (seconds, row.estimate_seconds)
            for seconds, row in zip(ran, rows, strict=True)
            if row.estimate_seconds
        ]
        ratio = (
            sum(seconds for seconds, _ in estimated) / sum(guess for _, guess in estimated)
            if estimated
            else None
        )
        return History(sum(ran) / len(ran), ratio)
