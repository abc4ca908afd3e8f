"""Batches: many jobs asked for at once."""

import hashlib
import re
from typing import Annotated, Final
from urllib.parse import urlencode

from anyio import to_thread
from fastapi import APIRouter, Path, Query
from starlette.requests import Request
from starlette.responses import Response

from api_schemas.batches import BATCH_ID_PATTERN, Batch, BatchPage, Manifest
from api_schemas.cost import Cost
from api_schemas.jobs import CURSOR_PATTERN
from service import batch_views
from service.batch_views import batch_url, view
from service.batching import batch_body, items_of
from service.documentation import (
    JSON_BODY_CODES,
    LOCATION,
    OBSTACLE_CODES,
    Document,
    header,
    problems,
)
from service.engine_access import Configuration, Engine, asset_facts
from service.examples import batch_examples
from service.idempotency import IdempotencyKey, key_of
from service.json_body import json_bytes, parsed
from service.negotiation import JSON
from service.problems import ProblemError
from service.settings import Settings
from service.stored_files import names
from service.tenants import Tenant
from worker.jobs import batch as records
from worker.jobs.queue import JobQueue

router = APIRouter(prefix="/v1/batches", tags=["batches"])

BODIES_IN_ONE: Final = 16
"""A batch may be as long as this many of the longest other bodies."""

WELL_FORMED: Final = re.compile(BATCH_ID_PATTERN)
BatchId = Annotated[
    str, Path(description="The batch's name.", json_schema_extra={"pattern": BATCH_ID_PATTERN})
]
NO_STORE: Final = {"Cache-Control": "no-store"}
LINKS: Final = {
    name: {"operationId": operation, "parameters": {"batch_id": "$response.body#/id"}}
    for name, operation in (
        ("self", "get_batch"),
        ("cancel", "cancel_batch"),
        ("manifest", "get_manifest"),
    )
}
BODY: Final[Document] = {
    "requestBody": {
        "required": True,
        "content": {
            JSON: {
                "schema": {
                    "oneOf": [
                        {"$ref": "#/components/schemas/ListedBatch"},
                        {"$ref": "#/components/schemas/SweptBatch"},
                    ]
                },
                "examples": {name: {"value": body} for name, body in batch_examples().items()},
            }
        },
    }
}


@router.post(
    "",
    status_code=202,
    operation_id="create_batch",
    summary="Ask for many pictures at once",
    responses={
        202: {
            "description": "The batch: all of its jobs are recorded.",
            "model": Batch,
            "headers": LOCATION,
            "links": LINKS,
        },
        **problems(
            *JSON_BODY_CODES,
            *OBSTACLE_CODES,
            "sweep_pointer_unknown",
            "sweep_pointers_overlap",
            "sweep_lengths_differ",
            "sweep_value_invalid",
            "batch_too_large",
            "idempotency_key_reused",
            "queue_full",
            "draining",
            "storage_full",
        ),
    },
    openapi_extra=BODY,
)
async def create_batch(
    request: Request,
    engine: Engine,
    settings: Configuration,
    tenant: Tenant,
    idempotency_key: IdempotencyKey = None,
) -> Response:
    """Takes up to 1000 requests, or one request and the values that vary in it: all or nothing.

    A request may be for a texture or a render, and one without `output.format` makes a PNG.
    Pointers in a refusal lead into the body, to the item or the value that is to blame.
    """
    body = await json_bytes(request, BODIES_IN_ONE)
    batch = await to_thread.run_sync(
        _submit,
        body,
        idempotency_key,
        engine,
        settings,
        tenant,
        limiter=request.app.state.batching,
    )
    return _answer(batch, 202)


@router.get(
    "",
    operation_id="list_batches",
    summary="List batches",
    response_model=BatchPage,
    responses=problems("request_invalid"),
)
def list_batches(
    engine: Engine,
    tenant: Tenant,
    limit: Annotated[int, Query(ge=1, le=100, description="Batches on a page.")] = 20,
    cursor: Annotated[
        str | None, Query(pattern=CURSOR_PATTERN, description="From a page's `next`.")
    ] = None,
) -> Response:
    """Newest first; `next` leads to older ones."""
    found, more = engine.batches.page(tenant, cursor=cursor, limit=limit)
    query = urlencode({"limit": limit, "cursor": more})
    page = BatchPage(
        batches=[view(batch) for batch in found], next=f"/v1/batches?{query}" if more else None
    )
    return Response(page.model_dump_json(), headers=NO_STORE, media_type=JSON)


@router.get(
    "/{batch_id}",
    operation_id="get_batch",
    summary="Look at a batch",
    responses={
        200: {"description": "The batch.", "model": Batch, "headers": LOCATION, "links": LINKS},
        **problems("batch_unknown"),
    },
)
def get_batch(batch_id: BatchId, engine: Engine, tenant: Tenant) -> Response:
    """How far it is, and how many of its jobs are in which state."""
    return _answer(_find(engine, tenant, batch_id), 200)


@router.delete(
    "/{batch_id}",
    status_code=303,
    operation_id="cancel_batch",
    summary="Cancel a batch",
    responses={
        303: {
            "description": "The batch as it is now: its record stays, and this leads to it.",
            "model": Batch,
            "headers": LOCATION,
        },
        **problems("origin_refused", "batch_unknown"),
    },
)
def cancel_batch(batch_id: BatchId, engine: Engine, tenant: Tenant) -> Response:
    """Cancels its jobs that are not finished; asking again does no harm."""
    found = WELL_FORMED.fullmatch(batch_id)
    batch = engine.batches.cancel(tenant, batch_id) if found else None
    if batch is None:
        raise ProblemError("batch_unknown")
    return _answer(batch, 303)


@router.get(
    "/{batch_id}/manifest",
    operation_id="get_manifest",
    summary="List what a batch made",
    response_model=Manifest,
    responses={
        200: {
            "description": "Every item with its job, its digest and its file.",
            "headers": {"ETag": header("Changes with the manifest.")},
        },
        304: {
            "description": "The caller has it already.",
            "headers": {"ETag": header("Changes with the manifest.")},
        },
        **problems("batch_unknown"),
    },
)
def get_manifest(request: Request, batch_id: BatchId, engine: Engine, tenant: Tenant) -> Response:
    """One document with every item, in the order of the request. Heeds If-None-Match."""
    batch = _find(engine, tenant, batch_id)
    body = batch_views.manifest(batch, engine.batches.entries(batch.id)).model_dump_json().encode()
    etag = f'"{hashlib.sha256(body).hexdigest()}"'
    headers = {"ETag": etag, "Cache-Control": "private, no-cache"}
    if names(request.headers.get("if-none-match"), etag):
        return Response(status_code=304, headers=headers)
    return Response(body, headers=headers, media_type=JSON)


def _submit(
    content: bytes, name: str | None, engine: JobQueue, settings: Settings, tenant: str
) -> records.Batch:
    body = batch_body(parsed(content))
    key = key_of(router.prefix, name, body)
    if key is not None and (earlier := engine.batches.replayed(tenant, key)):
        return earlier
    items = items_of(
        body,
        lambda sha256: asset_facts(engine, tenant, sha256),
        Cost(settings.cost_limit_seconds, settings.cost_limit_bytes),
        tenant=tenant,
        time_limit_seconds=settings.time_limit_seconds,
    )
    return engine.batches.submit(tenant, items, key)


def _find(engine: JobQueue, tenant: str, batch_id: str) -> records.Batch:
    batch = engine.batches.get(tenant, batch_id) if WELL_FORMED.fullmatch(batch_id) else None
    if batch is None:
        raise ProblemError("batch_unknown")
    return batch


def _answer(batch: records.Batch, status: int) -> Response:
    return Response(
        view(batch).model_dump_json(),
        status_code=status,
        headers={"Location": batch_url(batch.id), **NO_STORE},
        media_type=JSON,
    )
