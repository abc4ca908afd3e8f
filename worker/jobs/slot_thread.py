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

from worker.jobs.assets import mentioned_in
from worker.jobs.claims import Claim
from worker.jobs.errors import JobsError
from worker.jobs.log_lines import telling
from worker.jobs.meters import technique
from worker.jobs.replacement import Replacement
from worker.jobs.settling import CRASH, Desk, settle
from worker.jobs.slot import Outcome, Slot
from worker.jobs.status import SlotStatus

REPORT_SECONDS: Final = 0.25
IDLE_LOOK_SECONDS: Final = 1.0
LONGEST_PAUSE_SECONDS: Final = 30.0

log = logging.getLogger(__name__)


@dataclass(frozen=True, slots=True)
class Doing:
    """What a slot is at; `since` on a clock that never jumps."""

    technique: str
    attempt: int
    since: float


class SlotThread(threading.Thread):
    """Owns a slot from its first warm-up to its end.

    Args:
        name: of the thread and the slot.
        make_slot: makes a slot, not yet started.
        desk: what all slot threads share.
        recycle_after: how many jobs a child does before a fresh one takes its place.
    """

    def __init__(
        self, name: str, make_slot: Callable[[], Slot], desk: Desk, recycle_after: int
    ) -> None:
        super().__init__(name=name, daemon=True)
        self.fingerprint: str | None = None
        self._doing: Doing | None = None
        self._done = 0
        self._make_slot = make_slot
        self._slot = make_slot()
        self._replacement: Replacement | None = None
        self._desk = desk
        self._recycle_after = recycle_after
        self._done_by_child = 0
        self._lost_by: str | None = None
        self._stopping = threading.Event()

    @property
    def is_warm(self) -> bool:
        """Whether its child could start on work at once, or is at it."""
        return self._slot.is_warm

    def status(self) -> SlotStatus:
        """How it is, for any thread to ask."""
        doing = self._doing
        return SlotStatus(
            name=self.name,
            is_warm=self.is_warm,
            jobs_done=self._done,
            technique=doing.technique if doing else None,
            attempt=doing.attempt if doing else None,
            seconds=time.monotonic() - doing.since if doing else None,
        )

    def stop(self) -> None:
        """Finish the work at hand and take no more."""
        self._stopping.set()
        if not self._slot.is_warm:
            self._slot.close()

    def abandon(self) -> None:
        """Stop now: the child is killed and the work at hand goes back into the queue."""
        self.stop()
        self._slot.close()

    def run(self) -> None:
        """Stay warm and work until told to stop."""
        pause = 1.0
        while not self._stopping.is_set():
            try:
                if self._slot.is_alive():
                    self._recycle()
                    self._work_or_wait()
                else:
                    self._warm()
                pause = 1.0
            except Exception as error:
                if self._stopping.is_set():
                    break
                is_a_bug = not isinstance(error, JobsError)
                log.error("%s pauses %.0f s: %s", self.name, pause, error, exc_info=is_a_bug)
                self._stopping.wait(pause)
                pause = min(2 * pause, LONGEST_PAUSE_SECONDS)
        if self._replacement is not None:
            self._replacement.close()
        self._slot.close()
        self._slot.kill()

    def _warm(self) -> None:
        if self.fingerprint is not None:
            self._desk.meters.restarted(self._lost_by or "died_idle")
        self._lost_by = None
        started = time.monotonic()
        self.fingerprint = self._slot.start().get("fingerprint")
        self._done_by_child = 0
        log.info("%s is warm after %.1f s", self.name, time.monotonic() - started)

    def _recycle(self) -> None:
        """Have a fresh child take over from one that has done enough, once that one is warm."""
        if self._replacement is None:
            if self._done_by_child >= self._recycle_after:
                self._replacement = Replacement(self._make_slot(), self._desk.warming)
            return
        if self._replacement.is_warming:
            return
        replacement, self._replacement = self._replacement, None
        self._done_by_child = 0
        if replacement.facts is None:
            log.warning("%s keeps its child: no other became warm", self.name)
            return
        old, self._slot = self._slot, replacement.slot
        self.fingerprint = replacement.facts.get("fingerprint")
        old.close()
        old.kill()
        self._desk.meters.restarted("recycled")

    def _work_or_wait(self) -> None:
        if self._stopping.is_set():
            return  # whoever abandons us may have closed the slot that was just replaced
        seen = self._desk.line.arrivals
        taken = self._desk.line.take()
        if taken is None:
            self._desk.line.wait(seen, IDLE_LOOK_SECONDS)
            return
        claim, cancelled = taken
        with telling(work=claim.work_id, slot=self.name):
            self._do(claim, cancelled)

    def _do(self, claim: Claim, cancelled: threading.Event) -> None:
        desk = self._desk
        half = desk.results.half(claim.work_id, claim.attempt)
        self._doing = Doing(technique(claim), claim.attempt, time.monotonic())
        desk.run_times.begin(claim.work_id)
        desk.meters.began(claim)
        try:
            outcome = self._attempt(claim, half, cancelled)
            seconds = desk.run_times.end(claim.work_id, counts=outcome.status != "cancelled")
            if outcome.status not in ("ok", "failed"):
                self._lost_by = outcome.status
            outcome = settle(desk, claim, half, outcome, self.fingerprint, self._stopping)
        finally:
            desk.line.done(claim.work_id)
            self._doing = None
            half.unlink(missing_ok=True)
            desk.results.preview(claim.work_id).unlink(missing_ok=True)
        desk.settled(claim.work_id)
        self._done += 1
        self._done_by_child += 1
        desk.meters.ended(claim, outcome, seconds)
        desk.assets.drop_unwanted(mentioned_in(claim.body))

    def _attempt(self, claim: Claim, half: Path, cancelled: threading.Event) -> Outcome:
        request = {
            "kind": claim.kind,
            "body": claim.body,
            "digest": claim.digest,
            "assets": str(self._desk.assets.folder),
            "preview": str(self._desk.results.preview(claim.work_id)),
        }
        next_report = time.monotonic() + REPORT_SECONDS  # short work is not worth a write
        furthest = 0.0

        def report(progress: float, stage: str) -> None:
            nonlocal next_report, furthest
            furthest = max(furthest, progress)
            if time.monotonic() >= next_report:
                next_report = time.monotonic() + REPORT_SECONDS
                with suppress(SQLAlchemyError, JobsError):  # progress is only told
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
