"""Jobs: look, list, cancel, and fetch what they made."""

from typing import Annotated, Final
from urllib.parse import urlencode

from fastapi import APIRouter, Query
from starlette.concurrency import run_in_threadpool
from starlette.requests import Request
from starlette.responses import Response

from api_schemas.jobs import CURSOR_PATTERN, Job, JobPage, State
from service.documentation import (
    DIGEST,
    ETAG,
    IF_HEADERS,
    JOB_ID,
    LATER,
    LOCATION,
    PICTURES,
    PREFER,
    PREFERENCE,
    Responses,
    header,
    job_links,
    problems,
)
from service.engine_access import Engine
from service.job_views import WELL_FORMED, found_job, job_url, require_succeeded, result, view
from service.negotiation import patience, require_accepted
from service.problems import ProblemError
from service.stored_files import INERT, names
from service.submission import job_answer, picture, waited
from service.tenants import Tenant
from worker.jobs.watch import news_id

router = APIRouter(tags=["jobs"])


@router.get(
    "/v1/jobs",
    operation_id="list_jobs",
    summary="List jobs",
    response_model=JobPage,
    responses=problems("request_invalid"),
)
def list_jobs(
    engine: Engine,
    tenant: Tenant,
    limit: Annotated[int, Query(ge=1, le=100, description="Jobs on a page.")] = 20,
    cursor: Annotated[
        str | None, Query(pattern=CURSOR_PATTERN, description="From a page's `next`.")
    ] = None,
    state: Annotated[State | None, Query(description="Only jobs in this state.")] = None,
) -> Response:
    """Newest first; `next` leads to older ones."""
    found, more = engine.list(tenant, cursor=cursor, limit=limit, state=state)
    query = {"limit": limit, "cursor": more} | ({"state": state} if state else {})
    page = JobPage(
        jobs=[view(job, engine.forecast.seconds_left(job)) for job in found],
        next=f"/v1/jobs?{urlencode(query)}" if more else None,
    )
    return Response(
        page.model_dump_json(),
        headers={"Cache-Control": "no-store"},
        media_type="application/json",
    )


JOB_HEADERS: Final = (
    LOCATION
    | PREFERENCE
    | LATER
    | {"ETag": header("Weak: changes whenever there is news of the job.")}
)
OUTSIDE: Final[Responses] = {
    200: {"description": "There is news.", "headers": JOB_HEADERS},
    304: {"description": "There is none.", "headers": JOB_HEADERS},
    **problems("job_unknown"),
}
FOUND: Final[Responses] = {
    **OUTSIDE,
    200: {
        "description": "The job.",
        "model": Job,
        "headers": JOB_HEADERS,
        "links": job_links(),
    },
}


@router.head(
    "/v1/jobs/{job_id}",
    operation_id="head_job",
    summary="Look at a job from outside",
    response_class=Response,
    responses=OUTSIDE,
    openapi_extra={"parameters": [PREFER]},
)
@router.get(
    "/v1/jobs/{job_id}",
    operation_id="get_job",
    summary="Look at a job",
    responses=FOUND,
    openapi_extra={"parameters": [PREFER]},
)
async def get_job(request: Request, job_id: JOB_ID, engine: Engine, tenant: Tenant) -> Response:
    """How far it is; `Prefer: wait=N` waits for its end. Heeds If-None-Match."""
    job = await run_in_threadpool(found_job, engine, tenant, job_id)
    seconds, applied = patience(request, 0)
    job = await waited(request, job, seconds, engine)
    etag = f'"{news_id(job)}"'
    headers = {"ETag": f"W/{etag}", "Cache-Control": "private, no-cache"}
    answer = job_answer(
        job, engine, 200, headers | ({"Preference-Applied": applied} if applied else {})
    )
    if names(request.headers.get("if-none-match"), etag):
        kept = {name: value for name, value in answer.headers.items() if "content" not in name}
        return Response(status_code=304, headers=kept)
    return answer


@router.delete(
    "/v1/jobs/{job_id}",
    status_code=303,
    operation_id="cancel_job",
    summary="Cancel a job",
    responses={
        303: {
            "description": "The job as it is now: its record stays, and this leads to it.",
            "model": Job,
            "headers": LOCATION,
        },
        **problems("origin_refused", "job_unknown", "storage_full"),
    },
)
def cancel_job(job_id: JOB_ID, engine: Engine, tenant: Tenant) -> Response:
    """Stops it wherever it is; a finished one stays as it is, and asking again does no harm."""
    job = engine.cancel(tenant, job_id) if WELL_FORMED.fullmatch(job_id) else None
    if job is None:
        raise ProblemError("job_unknown")
    return Response(
        view(job, engine.forecast.seconds_left(job)).model_dump_json(),
        status_code=303,
        headers={"Location": job_url(job.id), "Cache-Control": "no-store"},
        media_type="application/json",
    )


RESULT_REFUSALS: Final = problems(
    "job_unknown",
    "not_acceptable",
    "job_not_finished",
    "job_cancelled",
    "job_failed",
    "result_evicted",
    "range_not_satisfiable",
)
RESULT_HEADERS: Final = ETAG | DIGEST
RESULT: Final = {
    200: {"description": "The whole file.", "content": PICTURES, "headers": RESULT_HEADERS},
    206: {
        "description": "The part that was asked for.",
        "content": PICTURES,
        "headers": RESULT_HEADERS | {"Content-Range": header("Which part it is.")},
    },
    304: {"description": "The caller has it already.", "headers": RESULT_HEADERS},
    **RESULT_REFUSALS,
}


@router.head(
    "/v1/jobs/{job_id}/result",
    operation_id="head_result",
    summary="Look at a finished file from outside",
    response_class=Response,
    responses={status: item for status, item in RESULT.items() if status not in (206, 416)},
)
@router.get(
    "/v1/jobs/{job_id}/result",
    operation_id="get_result",
    summary="Fetch a finished file",
    description=f"The file never changes. {IF_HEADERS}",
    response_class=Response,
    responses=RESULT,
)
def get_result(request: Request, job_id: JOB_ID, engine: Engine, tenant: Tenant) -> Response:
    """The file never changes."""
    job = found_job(engine, tenant, job_id)
    require_succeeded(job)
    require_accepted(request, result(job).media_type)
    return picture(request, job, engine, {"Vary": "Accept"})


@router.get(
    "/v1/jobs/{job_id}/preview",
    operation_id="get_preview",
    summary="See how far a job is",
    response_class=Response,
    responses={
        200: {
            "description": "A PNG of at most 256 x 256, of the step that was finished last.",
            "content": {"image/png": {}},
        },
        **problems("job_unknown", "preview_missing"),
    },
)
def get_preview(job_id: JOB_ID, engine: Engine, tenant: Tenant) -> Response:
    """There is one while a technique that goes by steps is running, and none afterwards."""
    path = engine.preview_path(found_job(engine, tenant, job_id))
    try:
        content = path.read_bytes() if path else None
    except FileNotFoundError:  # the job was finished meanwhile
        content = None
    if content is None:
        raise ProblemError("preview_missing")
    return Response(content, headers={**INERT, "Cache-Control": "no-store"}, media_type="image/png")
