"""Turns whatever goes wrong into a problem."""

import logging
from collections.abc import Awaitable, Callable
from typing import Any, Final

from fastapi import FastAPI
from fastapi.exceptions import RequestValidationError
from starlette.exceptions import HTTPException
from starlette.requests import ClientDisconnect, Request
from starlette.responses import Response
from starlette.routing import Match

from api_schemas.problems import Obstruction
from service.pointers import told
from service.problems import ProblemError
from worker.jobs.child import FULL_DISK
from worker.jobs.errors import (
    DrainingError,
    KeyReusedError,
    QueueFullError,
    RecordsBusyError,
    SlotError,
    StorageFullError,
    TenantFullError,
)

METHODS: Final = ("GET", "HEAD", "POST", "PUT", "PATCH", "DELETE")
SOON: Final = {"Retry-After": "5"}

log = logging.getLogger(__name__)

Handler = Callable[[Request, Any], Awaitable[Response]]


def install(app: FastAPI) -> None:
    """Have an app answer problems and nothing else."""
    handlers: dict[type[Exception], Handler] = {
        ProblemError: _problem,
        HTTPException: _routing,
        RequestValidationError: _parameters,
        QueueFullError: _queue_full,
        TenantFullError: _tenant_full,
        DrainingError: _draining,
        KeyReusedError: _key_reused,
        StorageFullError: _storage_full,
        OSError: _no_disk,
        SlotError: _no_slot,
        RecordsBusyError: _no_records,
        ClientDisconnect: _gone,
        Exception: _mistake,
    }
    for kind, handler in handlers.items():
        app.add_exception_handler(kind, handler)


def allowed_methods(request: Request) -> list[str]:
    """Return the methods that the request's path takes; starlette tells those of one route only."""
    return [
        method
        for method in METHODS
        if any(
            route.matches({**request.scope, "method": method})[0] is Match.FULL
            for route in request.app.router.routes
        )
    ]


async def _problem(_request: Request, error: ProblemError) -> Response:
    return error.response()


async def _routing(request: Request, error: HTTPException) -> Response:
    if error.status_code == 405:
        allow = ", ".join(allowed_methods(request))
        return ProblemError("method_not_allowed", headers={"Allow": allow}).response()
    if error.status_code == 404:
        return ProblemError("not_found").response()
    log.error("unforeseen HTTP status %d", error.status_code)
    return ProblemError("internal_error").response()


async def _parameters(_request: Request, error: RequestValidationError) -> Response:
    problems = []
    for item in error.errors():
        code, message = told(item["type"], item.get("ctx", {}))
        message = f"parameter {item['loc'][-1]} {message}"
        problems.append(Obstruction(code=code, pointer="", message=message))
    return ProblemError("request_invalid", problems[0].message, problems=problems).response()


async def _queue_full(_request: Request, error: QueueFullError) -> Response:
    return _busy("queue_full", error)


async def _tenant_full(_request: Request, error: TenantFullError) -> Response:
    return _busy("tenant_queue_full", error)


def _busy(code: str, error: QueueFullError) -> Response:
    headers = {"Retry-After": str(error.retry_after_seconds)}
    return ProblemError(code, str(error), headers=headers).response()


async def _draining(_request: Request, _error: DrainingError) -> Response:
    return ProblemError("draining", headers=SOON).response()


async def _key_reused(_request: Request, error: KeyReusedError) -> Response:
    return ProblemError("idempotency_key_reused", str(error)).response()


async def _storage_full(_request: Request, error: StorageFullError) -> Response:
    return ProblemError("storage_full", str(error), headers=SOON).response()


async def _no_disk(request: Request, error: OSError) -> Response:
    """An upload is written as it comes, and may be what fills the disk."""
    if error.errno not in FULL_DISK:
        raise error
    return await _storage_full(request, StorageFullError("the disk is full"))


async def _no_slot(_request: Request, error: SlotError) -> Response:
    log.error("no worker: %s", error)
    return ProblemError("not_ready", headers=SOON).response()


async def _no_records(_request: Request, error: RecordsBusyError) -> Response:
    log.error("no records: %s", error)
    return ProblemError("not_ready", str(error), headers=SOON).response()


async def _gone(_request: Request, _error: ClientDisconnect) -> Response:
    """Nobody hears this."""
    return Response(status_code=400)


async def _mistake(_request: Request, _error: Exception) -> Response:
    """The log has the stack trace: starlette raises the exception again for it."""
    return ProblemError("internal_error").response()
