"""How an attempt at work ends: its file is published or removed, and the records say so."""

import logging
import threading
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Final, TypeVar

from sqlalchemy.exc import SQLAlchemyError

from worker.jobs.assets import Assets
from worker.jobs.claims import Claim, Claims
from worker.jobs.errors import RecordsBusyError, StorageFullError, failure
from worker.jobs.line import Line
from worker.jobs.meters import Meters
from worker.jobs.results import Results
from worker.jobs.run_times import RunTimes
from worker.jobs.slot import Outcome

CRASH: Final = failure("worker_lost", "the worker process was lost")
STOPPED: Final = Outcome("crashed", failure=CRASH)

Answer = TypeVar("Answer")

log = logging.getLogger(__name__)


@dataclass(frozen=True, slots=True)
class Desk:
    """What the slot threads of one engine share.

    `settled` hears the id of work that changed; `warming` is held by the one who warms a
    replacement up, so that no more than one child is there beside the slots' own.
    """

    line: Line
    claims: Claims
    results: Results
    assets: Assets
    run_times: RunTimes
    meters: Meters
    settled: Callable[[str], None]
    warming: threading.Lock


def settle(
    desk: Desk,
    claim: Claim,
    half: Path,
    outcome: Outcome,
    fingerprint: str | None,
    stopping: threading.Event,
) -> Outcome:
    """Publish and record how an attempt ended; answers how it really did."""
    if outcome.status == "ok":
        made = outcome
        outcome = (
            _insisting(lambda: _publish(desk, claim, half, made, fingerprint), stopping) or STOPPED
        )
    if outcome.status != "ok":
        ended = outcome
        half.unlink(missing_ok=True)  # it may be what fills the disk that the record needs
        _insisting(lambda: _record(desk, claim, ended, stopping), stopping)
    return outcome


def _publish(
    desk: Desk, claim: Claim, half: Path, outcome: Outcome, fingerprint: str | None
) -> Outcome:
    """Publish a result and record success; a failure instead if that is not possible."""
    results = desk.results
    try:
        results.settle(half)
        accepted = desk.claims.succeed(
            claim,
            outcome.facts or {},
            fingerprint,
            lambda: results.publish(half, claim.work_id),
        )
    except RecordsBusyError:
        raise
    except StorageFullError as error:
        problem = failure("storage_full", str(error))
    except (OSError, SQLAlchemyError):
        log.exception("could not publish a result")
        problem = failure("internal_error", "the result could not be stored")
    else:
        return outcome if accepted else Outcome("cancelled")  # while it was being finished
    results.remove(claim.work_id)
    return Outcome("failed", failure=problem)


def _record(desk: Desk, claim: Claim, outcome: Outcome, stopping: threading.Event) -> None:
    problem = outcome.failure or CRASH
    claims = desk.claims
    if outcome.status == "cancelled" or (outcome.status == "crashed" and stopping.is_set()):
        claims.put_back(claim)
    elif outcome.status == "crashed":
        log.warning("attempt %d: %s", claim.attempt, problem["message"])
        claims.crash(claim, problem)
        desk.line.announce()
    else:
        claims.fail(claim, problem)


def _insisting(record: Callable[[], Answer], stopping: threading.Event) -> Answer | None:
    """Try until it is recorded, since a full disk may be emptied and a lock released.

    None when the engine stops first: what stays unrecorded is done again after the next start.
    """
    while True:
        try:
            return record()
        except (SQLAlchemyError, StorageFullError, RecordsBusyError):
            log.exception("could not record an outcome")
            if stopping.wait(1.0):
                return None
