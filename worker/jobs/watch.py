"""Tells any number of coroutines how their jobs are, and asks the records once for all of them.

One thread looks at all jobs that somebody follows, after something was written. Followers find the
latest news, never a queue of old ones: a slow one costs no more than a fast one.
"""

import asyncio
import hashlib
import json
import logging
import threading
import time
from collections.abc import Callable, Collection, Iterator, Mapping
from contextlib import contextmanager
from typing import Final

from sqlalchemy.exc import SQLAlchemyError

from worker.jobs.bell import Bell
from worker.jobs.errors import JobsError
from worker.jobs.job import FINAL_STATES, Job

LEAST_PAUSE_SECONDS: Final = 0.05
PAUSE_FOR_EACH_SECOND: Final = 5.0
"""Of rest after a look: however many jobs are followed, looking takes a sixth of one core."""

LONGEST_PAUSE_SECONDS: Final = 1.0
"""Between two looks while somebody follows: another process may have written."""

log = logging.getLogger(__name__)


def news_id(job: Job) -> str:
    """The name of what there is to tell about a job: equal news, equal names, after a restart too.

    The time that is left is not news: it changes with every look at the clock.
    """
    told = json.dumps([job.state, job.attempt, job.position, job.progress, job.stage])
    return hashlib.sha256(told.encode()).hexdigest()[:16]


class _Topic:
    """One followed job: how it was when last looked at, and by how many it is followed."""

    __slots__ = ("followers", "is_over", "job", "news")

    def __init__(self, job: Job) -> None:
        self.job = job
        self.news = news_id(job)
        self.is_over = job.state in FINAL_STATES
        self.followers = 0


class Follower:
    """One coroutine's view of one job."""

    def __init__(self, topic: _Topic, rung: asyncio.Event) -> None:
        self._topic = topic
        self._rung = rung

    @property
    def job(self) -> Job:
        """The job as it was when last looked at."""
        return self._topic.job

    @property
    def is_over(self) -> bool:
        """Whether there will be no more news: it is finished, or the engine has stopped."""
        return self._topic.is_over

    async def changed(self, patience_seconds: float) -> bool:
        """Wait for news; False when none came in time."""
        try:
            async with asyncio.timeout(patience_seconds):
                await self._rung.wait()
        except TimeoutError:
            return False
        self._rung.clear()
        return True


class Watch:
    """Everything that is followed in one engine.

    Args:
        look: answers those of the jobs of the ids that still exist, by id.
    """

    def __init__(self, look: Callable[[Collection[str]], Mapping[str, Job]]) -> None:
        self._look = look
        self._bell = Bell()
        self._lock = threading.Lock()
        self._topics: dict[str, _Topic] = {}
        self._written = threading.Event()
        self._stopping = threading.Event()
        self._thread = threading.Thread(target=self._run, name="watch", daemon=True)

    @property
    def followers(self) -> int:
        """How many follow some job right now."""
        with self._lock:
            return sum(topic.followers for topic in self._topics.values())

    def start(self) -> None:
        """Begin to look."""
        self._thread.start()

    def close(self) -> None:
        """Look once more, and send all followers home."""
        self._stopping.set()
        self._written.set()
        if self._thread.is_alive():
            self._thread.join()
        self._refresh()
        with self._lock:
            topics = dict(self._topics)
        for job_id, topic in topics.items():
            topic.is_over = True
            self._bell.ring(job_id)

    def wake(self) -> None:
        """Hear that something was written; from any thread, and often."""
        self._written.set()

    @contextmanager
    def following(self, job: Job) -> Iterator[Follower]:
        """News of a job from now on, for a coroutine of the running loop."""
        with self._lock:
            topic = self._topics.setdefault(job.id, _Topic(job))
            topic.followers += 1
            topic.is_over |= self._stopping.is_set()
        try:
            with self._bell.listening(job.id) as rung:
                self.wake()  # it may have changed since `job` was read
                yield Follower(topic, rung)
        finally:
            with self._lock:
                topic.followers -= 1
                if not topic.followers:
                    del self._topics[job.id]

    def _run(self) -> None:
        while not self._stopping.is_set():
            self._written.wait(LONGEST_PAUSE_SECONDS if self._topics else None)
            self._written.clear()
            began = time.monotonic()
            self._refresh()
            took = time.monotonic() - began
            self._stopping.wait(max(LEAST_PAUSE_SECONDS, PAUSE_FOR_EACH_SECOND * took))

    def _refresh(self) -> None:
        with self._lock:
            asked = [job_id for job_id, topic in self._topics.items() if not topic.is_over]
        if not asked:
            return
        try:
            found = self._look(asked)
        except (SQLAlchemyError, JobsError):
            log.exception("could not look at the followed jobs")
            return
        for job_id in asked:
            if self._tell(job_id, found.get(job_id)):
                self._bell.ring(job_id)

    def _tell(self, job_id: str, job: Job | None) -> bool:
        """Note how a job is; whether that is news."""
        with self._lock:
            topic = self._topics.get(job_id)
            if topic is None:
                return False
            if job is None:
                topic.is_over = True
                return True
            news = news_id(job)
            if news == topic.news:
                return False
            topic.job, topic.news = job, news
            topic.is_over = job.state in FINAL_STATES
            return True
