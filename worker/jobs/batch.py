"""A batch as its caller sees it: many jobs that were asked for at once."""

from dataclasses import dataclass
from typing import Any

from worker.errors import Failure
from worker.jobs.intake import Request
from worker.jobs.job import State


@dataclass(frozen=True, slots=True)
class Item:
    """One job to be; `values` are those that a sweep gave it, by pointer."""

    request: Request
    values: dict[str, Any] | None = None


@dataclass(frozen=True, slots=True)
class Batch:
    """Many jobs of one caller; times are seconds since 1970.

    `counts` tells how many are in each state, `progress` (0..1) the mean of theirs, where what has
    ended is done; `finished` is there when all have.
    """

    id: str
    tenant: str
    size: int
    created: float
    counts: dict[State, int]
    progress: float
    finished: float | None


@dataclass(frozen=True, slots=True)
class Entry:
    """What became of one item; `failure` and `facts` as in `Job`."""

    place: int
    values: dict[str, Any] | None
    job_id: str
    kind: str
    digest: str
    state: State
    failure: Failure | None
    facts: dict[str, Any] | None
