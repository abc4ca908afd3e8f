"""A job as its caller sees it."""

from dataclasses import dataclass
from typing import Any, Final, Literal

from worker.errors import Failure

Priority = Literal["interactive", "batch"]
State = Literal["queued", "running", "succeeded", "failed", "cancelled"]

PRIORITIES: Final[tuple[Priority, ...]] = ("interactive", "batch")
FINAL_STATES: Final[frozenset[State]] = frozenset({"succeeded", "failed", "cancelled"})


@dataclass(frozen=True, slots=True)
class Job:
    """One caller's request; times are seconds since 1970.

    `work_id` names the work behind it, which other jobs of the tenant may share. `attempt`,
    `progress` (0..1) and `stage` are the work's; `failure` is there when the state is failed,
    `facts` (what the executor answered) when it is succeeded, `position` (1 = next) while it is
    queued. `estimate_seconds` is what the cost model expected of the work, on one core.
    """

    id: str
    tenant: str
    kind: str
    priority: Priority
    digest: str
    state: State
    attempt: int
    progress: float
    stage: str | None
    created: float
    started: float | None
    finished: float | None
    failure: Failure | None
    facts: dict[str, Any] | None
    position: int | None
    estimate_seconds: float | None
    work_id: str
