"""Requests for renders."""

from typing import Annotated

from fastapi import APIRouter, Depends
from starlette.requests import Request
from starlette.responses import Response

from api_schemas.requests import RenderRequest
from service.documentation import PREFER, SUBMITTED, json_request
from service.engine_access import Configuration, Engine
from service.examples import examples
from service.idempotency import IdempotencyKey, key_of
from service.json_body import body_of
from service.submission import submitted
from service.tenants import Tenant

router = APIRouter(tags=["pictures"])


@router.post(
    "/v1/renders",
    status_code=202,
    operation_id="create_render",
    summary="Render a scene",
    responses=SUBMITTED,
    openapi_extra={
        "parameters": [PREFER],
        **json_request("RenderRequest", examples("render")),
    },
)
async def create_render(
    request: Request,
    body: Annotated[RenderRequest, Depends(body_of(RenderRequest))],
    engine: Engine,
    settings: Configuration,
    tenant: Tenant,
    idempotency_key: IdempotencyKey = None,
) -> Response:
    """Takes a specification, answers a job; or the picture itself where Accept prefers an image.

    A picture is waited for 30 seconds, or as long as `Prefer: wait=N` says; if it takes longer, the
    answer is the job.
    """
    key = key_of("/v1/renders", idempotency_key, body)
    return await submitted(request, body, engine, settings, tenant, key)
