"""From a request that fits its schema to one that can be done: facts, obstacles, cost, digest."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import TypeAlias

from api_schemas.asset_use import misuses
from api_schemas.assets import AssetFacts
from api_schemas.cost import Cost
from api_schemas.digest import digest
from api_schemas.estimate import estimate
from api_schemas.feasibility import assets_in, obstacles
from api_schemas.normalise import formatted, normalise
from api_schemas.obstacle import Obstacle
from api_schemas.output import Format
from api_schemas.problems import PROBLEMS_MAX, CostFigures, Obstruction
from api_schemas.relief_use import relief_misuses
from api_schemas.requests import Kind, RenderRequest, Request
from service.problems import ProblemError

FindFacts: TypeAlias = Callable[[str], AssetFacts | None]


@dataclass(frozen=True, slots=True)
class Finding:
    """What became of a request; `request` and `digest` are missing while an asset is."""

    problems: list[Obstruction]
    estimate: CostFigures
    limit: CostFigures
    request: Request | None
    digest: str | None


def examine(request: Request, file_format: Format, find_facts: FindFacts, limit: Cost) -> Finding:
    """Find out whether a request can be done, what it takes, and what it is called."""
    request = formatted(request, file_format)
    assets = assets_in(request)
    known = {sha256: find_facts(sha256) for sha256 in {sha256 for _, sha256 in assets}}
    facts = {sha256: found for sha256, found in known.items() if found is not None}
    whole = len(facts) == len(known)
    missing = (
        Obstacle("asset_missing", pointer, "no such asset has been uploaded")
        for pointer, sha256 in assets
        if sha256 not in facts
    )
    misused = (*misuses(request, facts), *relief_misuses(request, facts))
    found = (*obstacles(request), *missing, *misused)
    problems = [
        Obstruction(code=item.code, pointer=item.pointer, message=item.message)
        for item in found[: PROBLEMS_MAX - 1]
    ]
    cost = estimate(request, facts)
    if cost.exceeds(limit):
        message = (
            f"would take {cost.seconds:.3g} s and {cost.bytes:.3g} bytes; "
            f"at most {limit.seconds:.3g} s and {limit.bytes:.3g} bytes"
        )
        problems.append(Obstruction(code="over_budget", pointer="", message=message))
    settled = normalise(request, file_format, facts) if whole else None
    return Finding(
        problems=problems,
        estimate=_figures(cost),
        limit=_figures(limit),
        request=settled,
        digest=digest(settled) if settled else None,
    )


def admitted(finding: Finding) -> tuple[Request, str]:
    """Return the settled request and its digest.

    Raises:
        ProblemError: Something stands in its way.
    """
    if finding.problems or finding.request is None or finding.digest is None:
        first = finding.problems[0]
        over = any(item.code == "over_budget" for item in finding.problems)
        raise ProblemError(
            first.code,
            first.message,
            pointer=first.pointer,
            problems=finding.problems,
            estimate=finding.estimate if over else None,
            limit=finding.limit if over else None,
        )
    return finding.request, finding.digest


def kind_of(request: Request) -> Kind:
    """Return what a request asks for."""
    return "render" if isinstance(request, RenderRequest) else "texture"


def _figures(cost: Cost) -> CostFigures:
    return CostFigures(seconds=cost.seconds, bytes=cost.bytes)
