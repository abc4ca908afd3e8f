"""What happens to a job, as it happens."""

import resource
from typing import Final

from fastapi import APIRouter
from starlette.concurrency import run_in_threadpool
from starlette.requests import Request
from starlette.responses import Response

from service.documentation import JOB_ID, TEXT, Document, problems
from service.engine_access import Engine
from service.event_stream import MEDIA_TYPE, EventStream
from service.job_views import found_job
from service.negotiation import require_accepted
from service.problems import ProblemError
from service.tenants import Tenant
from worker.jobs.job import FINAL_STATES
from worker.jobs.watch import news_id

router = APIRouter(tags=["jobs"])

SHARE_OF_FILES: Final = 2
"""Streams take at most this part of the files that may be open: the rest is for the work."""

EVENT: Final[Document] = {
    "type": "object",
    "description": "One event.",
    "required": ["event", "id", "data"],
    "properties": {
        "event": {
            "enum": ["progress", "end"],
            "description": "`end` comes once, with the job in its final state, and is the last.",
        },
        "id": {"type": "string", "pattern": "^[0-9a-f]{16}$", "description": "Names the news."},
        "data": {
            "type": "string",
            "contentMediaType": "application/json",
            "contentSchema": {"$ref": "#/components/schemas/Job"},
            "description": "The job.",
        },
        "retry": {"type": "integer", "description": "Milliseconds to wait before reconnecting."},
    },
}
LAST_EVENT_ID: Final[Document] = {
    "name": "Last-Event-ID",
    "in": "header",
    "required": False,
    "description": "The id of the last event one has heard; what it told is not told again.",
    "schema": TEXT,
}


@router.get(
    "/v1/jobs/{job_id}/events",
    operation_id="get_events",
    summary="Follow a job",
    response_class=Response,
    responses={
        200: {
            "description": "Server-sent events: the job as it is now, then whenever that changes.",
            "content": {MEDIA_TYPE: {"schema": EVENT}},
        },
        204: {"description": "The job is finished, and the caller has heard of it."},
        **problems("job_unknown", "not_acceptable", "too_many_streams"),
    },
    openapi_extra={"parameters": [LAST_EVENT_ID]},
)
async def get_events(request: Request, job_id: JOB_ID, engine: Engine, tenant: Tenant) -> Response:
    """State, progress, stage, place in the queue and the time that is left, as server-sent events.

    The stream ends when the job is finished. When it breaks before, asking again with Last-Event-ID
    goes on where it broke, whether or not the service was started anew in between.
    """
    require_accepted(request, MEDIA_TYPE)
    job = await run_in_threadpool(found_job, engine, tenant, job_id)
    heard = request.headers.get("last-event-id")
    if job.state in FINAL_STATES and heard == news_id(job):
        return Response(status_code=204, headers={"Cache-Control": "no-store"})
    if engine.watch.followers >= most_streams():
        raise ProblemError("too_many_streams", headers={"Retry-After": "5"})
    return EventStream(engine, job, heard)


def most_streams() -> int:
    """Return how many streams may be open: each of them holds a connection, and so a file."""
    return resource.getrlimit(resource.RLIMIT_NOFILE)[0] // SHARE_OF_FILES
