"""The way of a request for a picture: settle, admit, submit, perhaps wait, answer."""

import asyncio
from typing import Final

from starlette.concurrency import run_in_threadpool
from starlette.requests import Request
from starlette.responses import Response

from api_schemas.cost import Cost
from api_schemas.output import MEDIA_TYPES
from api_schemas.requests import Request as PictureRequest
from service.admission import admitted, examine, kind_of
from service.engine_access import asset_facts
from service.job_views import RETRY_SECONDS, job_url, require_succeeded, result, result_url, view
from service.negotiation import Wish, require_accepted, wish
from service.problems import ProblemError
from service.settings import Settings
from service.stored_files import stored_file
from worker.jobs.idempotency import Key
from worker.jobs.job import FINAL_STATES, Job
from worker.jobs.queue import JobQueue

LONGEST_NAP_SECONDS: Final = 1.0


async def submitted(
    request: Request,
    body: PictureRequest,
    engine: JobQueue,
    settings: Settings,
    tenant: str,
    key: Key | None,
) -> Response:
    """Answer a request for a picture with its job, or with the picture where that is wished.

    A key that was sent before leads to the job that it made then.

    Raises:
        ProblemError: It cannot be done, or its job failed while the caller waited for the picture.
    """
    wished = wish(request, body.output.format, settings.wait_seconds)
    job = await run_in_threadpool(_submit, body, wished, engine, settings, tenant, key)
    job = await waited(request, job, wished.wait_seconds, engine)
    applied = {"Preference-Applied": wished.applied} if wished.applied else {}
    if wished.picture and job.state in FINAL_STATES:
        require_succeeded(job)
        require_accepted(request, result(job).media_type)  # the key may stand for another format
        return await run_in_threadpool(picture, request, job, engine, applied)
    return job_answer(job, engine, 200 if job.state in FINAL_STATES else 202, applied)


async def waited(request: Request, job: Job, seconds: float, engine: JobQueue) -> Job:
    """Return a job as soon as it is finished, the time is up, or the service is about to end."""
    loop = asyncio.get_running_loop()
    deadline = loop.time() + seconds
    drained = request.app.state.drained
    while job.state not in FINAL_STATES and not drained.is_set():
        patience = min(deadline - loop.time(), LONGEST_NAP_SECONDS)
        if patience <= 0:
            break
        job = await engine.finished(job, patience)
    return job


def job_answer(job: Job, engine: JobQueue, status: int, headers: dict[str, str]) -> Response:
    """Answer with a job; one that is not finished says when to ask again."""
    later = {} if job.state in FINAL_STATES else {"Retry-After": str(RETRY_SECONDS)}
    return Response(
        view(job, engine.forecast.seconds_left(job)).model_dump_json(),
        status_code=status,
        headers={
            "Location": job_url(job.id),
            "Cache-Control": "no-store",
            "Vary": "Accept, Prefer",
            **later,
            **headers,
        },
        media_type="application/json",
    )


def picture(request: Request, job: Job, engine: JobQueue, headers: dict[str, str]) -> Response:
    """Answer with a succeeded job's file.

    Raises:
        ProblemError: The file has been removed.
    """
    path = engine.result_path(job)
    file = result(job)
    suffix = next(name for name, kind in MEDIA_TYPES.items() if kind == file.media_type)
    try:
        if path is None:
            raise FileNotFoundError
        return stored_file(
            request,
            path,
            media_type=file.media_type,
            sha256=file.sha256,
            headers={
                "Texloom-Digest": job.digest,
                "Content-Location": result_url(job.id),
                "Content-Disposition": f'inline; filename="{job.digest[:12]}.{suffix}"',
                **headers,
            },
        )
    except FileNotFoundError:
        detail = "ask for the picture again to have it made again"
        raise ProblemError("result_evicted", detail, instance=job_url(job.id)) from None


def _submit(
    body: PictureRequest,
    wished: Wish,
    engine: JobQueue,
    settings: Settings,
    tenant: str,
    key: Key | None,
) -> Job:
    if key is not None and (earlier := engine.replayed(tenant, key)):
        return earlier
    limit = Cost(settings.cost_limit_seconds, settings.cost_limit_bytes)
    finding = examine(
        body, wished.file_format, lambda sha256: asset_facts(engine, tenant, sha256), limit
    )
    settled, digest = admitted(finding)
    return engine.submit(
        kind_of(settled),
        settled.model_dump(mode="json"),
        digest,
        tenant=tenant,
        priority=settled.priority,
        estimate_seconds=finding.estimate.seconds,
        key=key,
    )
