"""Keeps the store in step with the records, and within its limits."""

import logging
import threading
import time
from typing import Final

from sqlalchemy import select, update
from sqlalchemy.exc import SQLAlchemyError

from worker.jobs.assets import Assets
from worker.jobs.database import Database
from worker.jobs.errors import JobsError
from worker.jobs.meters import Meters
from worker.jobs.results import Results
from worker.jobs.schema import work

INTERVAL_SECONDS: Final = 10.0
AT_ONCE: Final = 500

log = logging.getLogger(__name__)


class Housekeeping:
    """Checks the store at the start, and evicts results from then on."""

    def __init__(
        self, database: Database, results: Results, assets: Assets, meters: Meters
    ) -> None:
        self._database = database
        self._results = results
        self._assets = assets
        self._meters = meters
        self._stopping = threading.Event()
        self._thread = threading.Thread(target=self._run, name="housekeeping", daemon=True)

    def check(self) -> None:
        """Remove what should not be there, and note what should be and is not."""
        query = select(work.c.id, work.c.facts["bytes"].as_integer()).where(
            work.c.state == "succeeded", work.c.evicted.is_(None)
        )
        with self._database.reading() as connection:
            expected = {row[0]: row[1] for row in connection.execute(query)}
        missing = self._results.sweep(expected)
        if missing:
            log.warning(
                "%d results are missing; asked for again, they are made again", len(missing)
            )
            self._record(missing)
        lost = self._assets.sweep()
        if lost:
            log.warning("%d uploads are missing and have to be sent again", lost)

    def start(self) -> None:
        """Begin to evict."""
        self._thread.start()

    def stop(self) -> None:
        """End, and wait for the end."""
        self._stopping.set()
        if self._thread.is_alive():
            self._thread.join()

    def evict(self) -> None:
        """Remove the results that are beyond the limits."""
        before = self._results.bytes
        evicted = self._results.evict()
        if evicted:
            self._meters.moved("results_evicted", max(0, before - self._results.bytes))
            log.info("evicted %d results", len(evicted))
            self._record(evicted)

    def _run(self) -> None:
        while not self._stopping.wait(INTERVAL_SECONDS):
            try:
                self.evict()
            except (OSError, SQLAlchemyError, JobsError):
                log.exception("could not evict results")

    def _record(self, work_ids: list[str]) -> None:
        now = time.time()
        with self._database.writing(durably=False) as connection:
            for first in range(0, len(work_ids), AT_ONCE):
                some = work.c.id.in_(work_ids[first : first + AT_ONCE])
                connection.execute(update(work).where(some).values(evicted=now))
