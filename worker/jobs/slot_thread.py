"""A thread that keeps one slot warm and has it do one work after another."""

import logging
import threading
import time
from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from typing import Final

from sqlalchemy.exc import SQLAlchemyError

from worker.jobs.assets import Assets, mentioned_in
from worker.jobs.claims import Claim, Claims
from worker.jobs.errors import SlotError, StorageFullError, failure
from worker.jobs.line import Line
from worker.jobs.results import Results
from worker.jobs.slot import Outcome, Slot

REPORT_SECONDS: Final = 0.25
IDLE_LOOK_SECONDS: Final = 1.0
LONGEST_PAUSE_SECONDS: Final = 30.0
CRASH: Final = failure("worker_lost", "the worker process was lost")

log = logging.getLogger(__name__)


@dataclass(frozen=True, slots=True)
class Desk:
    """What the slot threads of one engine share; `settled` hears the id of work that changed."""

    line: Line
    claims: Claims
    results: Results
    assets: Assets
    settled: Callable[[str], None]


class SlotThread(threading.Thread):
    """Owns a slot from its first warm-up to its end."""

    def __init__(self, name: str, slot: Slot, desk: Desk) -> None:
        super().__init__(name=name, daemon=True)
        self.fingerprint: str | None = None
        self._slot = slot
        self._desk = desk
        self._stopping = threading.Event()

    @property
    def is_warm(self) -> bool:
        """Whether its child could start on work at once, or is at it."""
        return self._slot.is_warm

    def stop(self) -> None:
        """Finish the work at hand and take no more."""
        self._stopping.set()
        if not self._slot.is_warm:
            self._slot.close()

    def abandon(self) -> None:
        """Stop now: the child is killed and the work at hand goes back into the queue."""
        self._stopping.set()
        self._slot.close()

    def run(self) -> None:
        """Stay warm and work until told to stop."""
        pause = 1.0
        while not self._stopping.is_set():
            try:
                if self._slot.is_alive():
                    self._work_or_wait()
                else:
                    self._warm()
                pause = 1.0
            except Exception as error:
                if self._stopping.is_set():
                    break
                is_a_bug = not isinstance(error, SlotError)
                log.error("%s pauses %.0f s: %s", self.name, pause, error, exc_info=is_a_bug)
                self._stopping.wait(pause)
                pause = min(2 * pause, LONGEST_PAUSE_SECONDS)
        self._slot.close()
        self._slot.kill()

    def _warm(self) -> None:
        started = time.monotonic()
        self.fingerprint = self._slot.start().get("fingerprint")
        log.info("%s is warm after %.1f s", self.name, time.monotonic() - started)

    def _work_or_wait(self) -> None:
        seen = self._desk.line.arrivals
        taken = self._desk.line.take()
        if taken is None:
            self._desk.line.wait(seen, IDLE_LOOK_SECONDS)
            return
        claim, cancelled = taken
        half = self._desk.results.half(claim.work_id, claim.attempt)
        try:
            outcome = self._do(claim, half, cancelled)
            self._settle(claim, half, outcome)
        finally:
            self._desk.line.done(claim.work_id)
            half.unlink(missing_ok=True)
        self._desk.settled(claim.work_id)
        self._desk.assets.drop_unwanted(mentioned_in(claim.body))

    def _do(self, claim: Claim, half: Path, cancelled: threading.Event) -> Outcome:
        request = {
            "kind": claim.kind,
            "body": claim.body,
            "digest": claim.digest,
            "assets": str(self._desk.assets.folder),
        }
        next_report = time.monotonic() + REPORT_SECONDS  # short work is not worth a write
        furthest = 0.0

        def report(progress: float, stage: str) -> None:
            nonlocal next_report, furthest
            furthest = max(furthest, progress)
            if time.monotonic() >= next_report:
                next_report = time.monotonic() + REPORT_SECONDS
                with suppress(SQLAlchemyError, StorageFullError):  # progress is only told
                    self._desk.claims.report(claim, furthest, stage)

        try:
            return self._slot.run(
                request,
                half,
                time_limit_seconds=claim.time_limit_seconds,
                cancelled=cancelled,
                report=report,
            )
        except Exception:
            log.exception("%s lost its child", self.name)
            return Outcome("crashed", failure=CRASH)

    def _settle(self, claim: Claim, half: Path, outcome: Outcome) -> None:
        """Publish and record how it ended."""
        if outcome.status == "ok":
            outcome = self._publish(claim, half, outcome)
        if outcome.status != "ok":
            half.unlink(missing_ok=True)  # it may be what fills the disk that the record needs
            self._until_recorded(lambda: self._record(claim, outcome))

    def _publish(self, claim: Claim, half: Path, outcome: Outcome) -> Outcome:
        """Publish a result and record success; a failure instead if that is not possible."""
        results = self._desk.results
        try:
            results.settle(half)
            self._desk.claims.succeed(
                claim,
                outcome.facts or {},
                self.fingerprint,
                lambda: results.publish(half, claim.work_id),
            )
        except StorageFullError as error:
            problem = failure("storage_full", str(error))
        except (OSError, SQLAlchemyError):
            log.exception("could not publish the result of work %s", claim.work_id)
            problem = failure("internal_error", "the result could not be stored")
        else:
            return outcome
        results.remove(claim.work_id)
        return Outcome("failed", failure=problem)

    def _record(self, claim: Claim, outcome: Outcome) -> None:
        problem = outcome.failure or CRASH
        claims = self._desk.claims
        if outcome.status == "cancelled" or (
            outcome.status == "crashed" and self._stopping.is_set()
        ):
            claims.put_back(claim)
        elif outcome.status == "crashed":
            log.warning("work %s, attempt %d: %s", claim.work_id, claim.attempt, problem["message"])
            claims.crash(claim, problem)
            self._desk.line.announce()
        else:
            claims.fail(claim, problem)

    def _until_recorded(self, record: Callable[[], None]) -> None:
        """Insist, since a full disk may be emptied; what stays unrecorded is redone at restart."""
        while True:
            try:
                return record()
            except (SQLAlchemyError, StorageFullError):
                log.exception("%s could not record an outcome", self.name)
                if self._stopping.wait(1.0):
                    return None
