"""From the body of a batch to items that can all be done, or to the news of what cannot."""

import operator
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from functools import cache, partial
from typing import Any, Final

from api_schemas.batches import ListedBatch, SweptBatch
from api_schemas.cost import Cost
from api_schemas.problems import CostFigures, Obstruction
from api_schemas.requests import Request
from service.admission import FindFacts, Finding, examine, kind_of
from service.json_body import fitted
from service.pointers import MOST_TOLD
from service.problems import ProblemError
from service.sweeps import variations
from worker.jobs.batch import Item
from worker.jobs.intake import Request as Work

TIMES_THE_COST_OF_ONE: Final = 60
"""What a batch may cost, in the longest requests that are taken: an hour, where one is a minute."""

BYTES_MAX: Final = 64 << 20
"""Of all requests of a batch, written out: a sweep of a large scene could be a gigabyte."""


@dataclass(frozen=True, slots=True)
class _Wanted:
    """One request of a batch; `origin` says where in the body a pointer into it leads."""

    request: Request
    values: dict[str, Any] | None
    origin: Callable[[str], str]


def batch_body(value: Any) -> ListedBatch | SweptBatch:
    """Return a parsed body as the kind of batch that it means to be.

    Raises:
        ProblemError: It does not fit.
    """
    if isinstance(value, dict) and ("sweep" in value or "request" in value):
        return fitted(SweptBatch, value)
    return fitted(ListedBatch, value)


def items_of(
    body: ListedBatch | SweptBatch,
    find_facts: FindFacts,
    limit: Cost,
    *,
    tenant: str,
    time_limit_seconds: float,
) -> list[Item]:
    """Return what is to be done.

    Raises:
        ProblemError: One of the requests cannot be done, or all together take too long.
    """
    known = cache(find_facts)
    problems: list[Obstruction] = []
    items: list[Item] = []
    costs: dict[str, float] = {}
    length = 0
    for number, wanted in enumerate(_wanted(body)):
        asked = wanted.request
        priority = asked.priority if "priority" in asked.model_fields_set else "batch"
        finding = examine(asked, asked.output.format or "png", known, limit)
        problems += _told(finding, number, wanted)
        if len(problems) >= MOST_TOLD:
            break
        if finding.request is None or finding.digest is None:
            continue
        settled = finding.request.model_copy(update={"priority": priority})
        costs[finding.digest] = finding.estimate.seconds
        length += len(settled.model_dump_json())
        if length > BYTES_MAX:
            raise ProblemError(
                "batch_too_large",
                f"{number + 1} of its requests have more than {BYTES_MAX} bytes together",
                pointer="",
            )
        work = Work(
            tenant=tenant,
            kind=kind_of(settled),
            body=settled.model_dump(mode="json"),
            digest=finding.digest,
            priority=priority,
            time_limit_seconds=time_limit_seconds,
            estimate_seconds=finding.estimate.seconds,
        )
        items.append(Item(work, wanted.values))
    if problems:
        first = problems[0]
        raise ProblemError(
            first.code, first.message, pointer=first.pointer, problems=problems[:MOST_TOLD]
        )
    _require_affordable(sum(costs.values()), limit)
    return items


def _wanted(body: ListedBatch | SweptBatch) -> Iterator[_Wanted]:
    if isinstance(body, SweptBatch):
        for item in variations(body):
            yield _Wanted(item.request, item.values, item.origin)
    else:
        for number, request in enumerate(body.items):
            yield _Wanted(request, None, partial(operator.add, f"/items/{number}"))


def _told(finding: Finding, number: int, wanted: _Wanted) -> list[Obstruction]:
    return [
        Obstruction(
            code=item.code,
            pointer=wanted.origin(item.pointer),
            message=f"item {number}: {item.message}",
        )
        for item in finding.problems
    ]


def _require_affordable(seconds: float, limit: Cost) -> None:
    """Refuse a batch that takes too long, equal requests counted once."""
    most = replace(limit, seconds=TIMES_THE_COST_OF_ONE * limit.seconds)
    if seconds > most.seconds:
        raise ProblemError(
            "over_budget",
            f"the batch would take {seconds:.3g} s; at most {most.seconds:.3g} s",
            pointer="",
            estimate=CostFigures(seconds=seconds, bytes=0),
            limit=CostFigures(seconds=most.seconds, bytes=most.bytes),
        )
