"""Uploaded pictures, named by the SHA-256 of their bytes."""

import pathlib
import re
from typing import Annotated, Final

from anyio import to_thread
from fastapi import APIRouter, Path
from starlette.concurrency import run_in_threadpool
from starlette.requests import Request
from starlette.responses import Response

from api_schemas.assets import AssetFacts
from api_schemas.base import SHA256_PATTERN
from service.documentation import BINARY, ETAG, IF_HEADERS, LOCATION, Responses, header, problems
from service.engine_access import Configuration, Engine, asset_facts
from service.negotiation import JSON, quality, require_accepted
from service.problems import ProblemError
from service.stored_files import names, stored_file
from service.tenants import Tenant
from service.uploads import FIELD, FORM, measured, passing, stored, upload
from worker.jobs.queue import JobQueue

router = APIRouter(prefix="/v1/assets", tags=["assets"])

WELL_FORMED: Final = re.compile(SHA256_PATTERN)
MEDIA_TYPES: Final = (
    "image/png",
    "image/x-exr",
    "image/jpeg",
    "image/tiff",
    "image/vnd.radiance",
)
Name = Annotated[
    str,
    Path(
        description="The SHA-256 of the file's bytes.",
        json_schema_extra={"pattern": SHA256_PATTERN},
    ),
]
BODY: Final = {
    "requestBody": {
        "required": True,
        "content": {
            **{name: {"schema": BINARY} for name in (*MEDIA_TYPES, "application/octet-stream")},
            FORM: {
                "schema": {
                    "type": "object",
                    "properties": {FIELD: BINARY},
                    "required": [FIELD],
                    "additionalProperties": False,
                }
            },
        },
    }
}
LINKS: Final = {
    name: {"operationId": operation, "parameters": {"sha256": "$response.body#/sha256"}}
    for name, operation in (("self", "get_asset"), ("delete", "delete_asset"))
}
CONTENT: Final = {name: {"schema": BINARY} for name in MEDIA_TYPES}
FOUND: Final[Responses] = {
    200: {
        "description": "The file; or, where Accept prefers JSON, what was measured of it.",
        "model": AssetFacts,
        "content": dict(CONTENT),
        "headers": ETAG,
    },
    206: {
        "description": "The part that was asked for.",
        "content": CONTENT,
        "headers": ETAG | {"Content-Range": header("Which part it is.")},
    },
    304: {"description": "The caller has it already.", "headers": ETAG},
    **problems("asset_unknown", "not_acceptable", "range_not_satisfiable"),
}


@router.post(
    "",
    status_code=201,
    operation_id="create_asset",
    summary="Upload a picture",
    responses={
        200: {
            "description": "It had been uploaded before.",
            "model": AssetFacts,
            "headers": LOCATION,
            "links": LINKS,
        },
        201: {
            "description": "It is there from now on.",
            "model": AssetFacts,
            "headers": LOCATION,
            "links": LINKS,
        },
        **problems(
            "origin_refused",
            "multipart_malformed",
            "asset_unusable",
            "asset_unsupported",
            "asset_too_large",
            "body_too_large",
            "media_type_unsupported",
            "request_invalid",
            "not_ready",
            "storage_full",
        ),
    },
    openapi_extra=BODY,
)
async def create_asset(
    request: Request, engine: Engine, settings: Configuration, tenant: Tenant
) -> Response:
    """Takes PNG, EXR, JPEG, TIFF and Radiance files, told by their content.

    The body is the file itself, or a form with one file field called `file`.
    """
    with passing(engine.assets.new_upload()) as path:
        sha256 = await stored(upload(request, settings.upload_limit_bytes), path)
        facts = await run_in_threadpool(asset_facts, engine, tenant, sha256)
        status = 200
        if facts is None:
            limit = settings.measure_limit_seconds
            facts = await to_thread.run_sync(
                measured, engine, path, sha256, limit, limiter=request.app.state.measuring
            )
            await run_in_threadpool(
                engine.assets.put, tenant, path, sha256, facts.model_dump(mode="json")
            )
            status = 201
    return Response(
        facts.model_dump_json(),
        status_code=status,
        headers={"Location": f"/v1/assets/{sha256}", "Cache-Control": "no-store"},
        media_type=JSON,
    )


@router.head(
    "/{sha256}",
    operation_id="head_asset",
    summary="Look at an upload from outside",
    response_class=Response,
    responses={status: item for status, item in FOUND.items() if status not in (206, 416)},
)
@router.get(
    "/{sha256}",
    operation_id="get_asset",
    summary="Fetch an upload",
    description="The file as it was uploaded; with `Accept: application/json`, what was measured "
    f"of it. {IF_HEADERS}",
    response_class=Response,
    responses=FOUND,
)
def get_asset(request: Request, sha256: Name, engine: Engine, tenant: Tenant) -> Response:
    """The file as it was uploaded."""
    facts, path = _find(engine, tenant, sha256)
    accept = request.headers.get("accept")
    if quality(accept, JSON) > quality(accept, facts.media_type):
        etag = f'"{sha256}-facts"'
        headers = {"ETag": etag, "Vary": "Accept", "Cache-Control": "private, no-cache"}
        if names(request.headers.get("if-none-match"), etag):
            return Response(status_code=304, headers=headers)
        return Response(facts.model_dump_json(), headers=headers, media_type=JSON)
    require_accepted(request, facts.media_type)
    headers = {
        "Content-Disposition": f'attachment; filename="{sha256[:12]}.{facts.format}"',
        "Vary": "Accept",
    }
    try:
        return stored_file(
            request, path, media_type=facts.media_type, sha256=sha256, headers=headers
        )
    except FileNotFoundError:  # deleted at this moment
        raise ProblemError("asset_unknown") from None


@router.delete(
    "/{sha256}",
    status_code=204,
    operation_id="delete_asset",
    summary="Delete an upload",
    response_class=Response,
    responses={
        204: {"description": "It is gone."},
        **problems("origin_refused", "asset_unknown", "storage_full"),
    },
)
def delete_asset(sha256: Name, engine: Engine, tenant: Tenant) -> Response:
    """Results made with it stay; new requests for it are refused."""
    if not WELL_FORMED.fullmatch(sha256) or not engine.assets.delete(tenant, sha256):
        raise ProblemError("asset_unknown")
    return Response(status_code=204)


def _find(engine: JobQueue, tenant: str, sha256: str) -> tuple[AssetFacts, pathlib.Path]:
    facts = path = None
    if WELL_FORMED.fullmatch(sha256):
        facts = asset_facts(engine, tenant, sha256)
        path = engine.assets.path(tenant, sha256)
    if facts is None or path is None:
        raise ProblemError("asset_unknown")
    return facts, path
