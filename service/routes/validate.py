"""A dry run: what would become of a request."""

from typing import Final

from fastapi import APIRouter
from starlette.concurrency import run_in_threadpool
from starlette.requests import Request
from starlette.responses import Response

from api_schemas.cost import Cost
from api_schemas.jobs import Validation
from api_schemas.requests import RenderRequest, TextureRequest
from service.admission import examine, kind_of
from service.documentation import JSON_BODY_CODES, problems
from service.engine_access import Configuration, Engine, asset_facts
from service.examples import examples
from service.json_body import fitted, json_bytes, parsed
from service.settings import Settings
from service.tenants import Tenant
from worker.jobs.queue import JobQueue

router = APIRouter(tags=["pictures"])

BODY: Final = {
    "requestBody": {
        "required": True,
        "content": {
            "application/json": {
                "schema": {
                    "oneOf": [
                        {"$ref": "#/components/schemas/TextureRequest"},
                        {"$ref": "#/components/schemas/RenderRequest"},
                    ]
                },
                "examples": {
                    name: {"value": body}
                    for name, body in {**examples("texture"), **examples("render")}.items()
                },
            }
        },
    }
}


@router.post(
    "/v1/validate",
    operation_id="validate",
    summary="Try a request without doing it",
    response_model=Validation,
    responses=problems(*JSON_BODY_CODES),
    openapi_extra=BODY,
)
async def validate(
    request: Request, engine: Engine, settings: Configuration, tenant: Tenant
) -> Response:
    """Takes the body of either kind of request; what stands in its way is part of the answer."""
    body = await json_bytes(request)
    answer = await run_in_threadpool(_validation, body, engine, settings, tenant)
    return Response(
        answer.model_dump_json(),
        headers={"Cache-Control": "no-store"},
        media_type="application/json",
    )


def _validation(body: bytes, engine: JobQueue, settings: Settings, tenant: str) -> Validation:
    value = parsed(body)
    scene = isinstance(value, dict) and "scene" in value
    asked = fitted(RenderRequest, value) if scene else fitted(TextureRequest, value)
    finding = examine(
        asked,
        asked.output.format or "png",
        lambda sha256: asset_facts(engine, tenant, sha256),
        Cost(settings.cost_limit_seconds, settings.cost_limit_bytes),
    )
    return Validation(
        kind=kind_of(asked),
        possible=not finding.problems,
        problems=finding.problems,
        estimate=finding.estimate,
        limit=finding.limit,
        digest=finding.digest,
        normalised=finding.request,
    )
