"""Uploaded pictures and models, named by the SHA-256 of their bytes."""

import pathlib
import re
from typing import Annotated, Final

from anyio import to_thread
from fastapi import APIRouter, Path
from starlette.concurrency import run_in_threadpool
from starlette.requests import Request
from starlette.responses import Response

from api_schemas.assets import ASSET_FACTS, AssetFacts
from api_schemas.base import SHA256_PATTERN
from service.documentation import BINARY, ETAG, IF_HEADERS, LOCATION, Responses, header, problems
from service.engine_access import Configuration, Engine, asset_facts
from service.negotiation import JSON, quality, require_accepted
from service.problems import ProblemError
from service.stored_files import names, stored_file
from service.tenants import Tenant
from service.uploads import (
    BUFFER,
    FIELD,
    FORM,
    may_be_more,
    measured_and_kept,
    passing,
    stored,
    upload,
)
from worker.jobs.queue import JobQueue

router = APIRouter(prefix="/v1/assets", tags=["assets"])

WELL_FORMED: Final = re.compile(SHA256_PATTERN)
SUFFIXES: Final = {
    "image/png": "png",
    "image/x-exr": "exr",
    "image/jpeg": "jpg",
    "image/tiff": "tif",
    "image/vnd.radiance": "hdr",
    "model/gltf-binary": "glb",
    "model/gltf+json": "gltf",
    "model/obj": "obj",
    "model/mtl": "mtl",
    "model/ply": "ply",
    "model/stl": "stl",
    BUFFER: "bin",
}
"""What is taken, and how its files' names end when they are fetched."""
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
            **{name: {"schema": BINARY} for name in (*SUFFIXES, "application/octet-stream")},
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
CONTENT: Final = {name: {"schema": BINARY} for name in SUFFIXES}
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
    summary="Upload a picture or a model",
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
    """Takes pictures (PNG, EXR, JPEG, TIFF, Radiance) and models (GLB, glTF, OBJ, MTL, PLY, STL).

    Their content tells what they are. Only the buffer beside a glTF file, which may hold anything,
    has to be called `application/gltf-buffer`. The body is the file itself, or a form with one file
    field called `file`.
    """
    with passing(engine.assets.new_upload()) as path:
        async with upload(request, settings.upload_limit_bytes) as sent:
            sha256 = await stored(sent.content, path)
        known = await run_in_threadpool(asset_facts, engine, tenant, sha256)
        if known is not None and not may_be_more(known, sent.media_type):
            facts = known
        else:
            try:
                facts = await to_thread.run_sync(
                    measured_and_kept,
                    engine,
                    tenant,
                    path,
                    sha256,
                    sent.media_type,
                    settings.measure_limit_seconds,
                    limiter=request.app.state.measuring,
                )
            except ProblemError:
                if known is None:
                    raise
                facts = known
    return Response(
        ASSET_FACTS.dump_json(facts),
        status_code=201 if known is None else 200,
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
        return Response(ASSET_FACTS.dump_json(facts), headers=headers, media_type=JSON)
    require_accepted(request, facts.media_type)
    suffix = SUFFIXES.get(facts.media_type, "bin")
    headers = {
        "Content-Disposition": f'attachment; filename="{sha256[:12]}.{suffix}"',
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
