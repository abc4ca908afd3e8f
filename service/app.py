"""Wires settings, engine, routes and refusals into one app."""

import threading
from collections.abc import AsyncIterator
from contextlib import asynccontextmanager
from functools import partial
from typing import Any

from anyio import CapacityLimiter
from fastapi import FastAPI
from fastapi_offline import FastAPIOffline
from starlette.concurrency import run_in_threadpool
from starlette.middleware.cors import CORSMiddleware

from api_schemas.version import VERSION
from service import error_handlers
from service.headers import SameOriginWrites, SecurityHeaders
from service.openapi_document import document
from service.request_log import RequestLog, RequestMeters
from service.routes import (
    assets,
    batches,
    events,
    front,
    health,
    jobs,
    renders,
    status,
    techniques,
    textures,
    validate,
)
from service.settings import Settings
from worker.jobs.engine import EmbeddedEngine
from worker.jobs.queue import JobQueue
from worker.jobs.results import Limits

ROUTES = (
    front,
    textures,
    renders,
    batches,
    validate,
    jobs,
    events,
    assets,
    techniques,
    health,
    status,
)

EXPOSED = (
    "Content-Location",
    "Content-Range",
    "ETag",
    "Location",
    "Preference-Applied",
    "Retry-After",
    "Texloom-Digest",
    "X-Request-Id",
)

MEASURED_AT_ONCE = 2
"""Uploads wait their turn here, so that they do not take all threads from everything else."""

BATCHES_AT_ONCE = 1
"""So do batches: to look into a thousand requests takes seconds, in threads that share one core."""


def create_app(settings: Settings, engine: JobQueue | None = None) -> FastAPI:
    """Return the app; an engine that is handed in is started and drained by its owner."""

    @asynccontextmanager
    async def lifespan(app: FastAPI) -> AsyncIterator[None]:
        if engine is not None:
            yield
            return
        app.state.engine = make_engine(settings)
        await run_in_threadpool(app.state.engine.start)
        yield
        await run_in_threadpool(app.state.engine.drain, settings.drain_seconds)

    app: FastAPI = FastAPIOffline(
        title="Texloom",
        version=VERSION,
        lifespan=lifespan,
        redirect_slashes=False,
        swagger_ui_parameters={"validatorUrl": None},
    )
    app.state.settings = settings
    app.state.engine = engine
    app.state.drained = threading.Event()
    app.state.measuring = CapacityLimiter(MEASURED_AT_ONCE)
    app.state.batching = CapacityLimiter(BATCHES_AT_ONCE)
    for resource in ROUTES:
        app.include_router(resource.router)
    error_handlers.install(app)
    app.add_middleware(SameOriginWrites, allowed=settings.cors_origins)
    if settings.cors_origins:
        app.add_middleware(
            CORSMiddleware,
            allow_origins=settings.cors_origins,
            allow_methods=["*"],
            allow_headers=["*"],
            expose_headers=EXPOSED,
        )
    app.add_middleware(SecurityHeaders)
    app.state.requests = RequestMeters()
    app.add_middleware(RequestLog, meters=app.state.requests)
    app.openapi = partial(_openapi, app)  # type: ignore[method-assign]
    return app


def make_engine(settings: Settings) -> EmbeddedEngine:
    """Return the engine that the settings ask for, not yet started."""
    return EmbeddedEngine(
        settings.data,
        slots=settings.slots,
        queue_limit=settings.queue_limit,
        tenant_queue_limit=settings.tenant_queue_limit,
        recycle_after=settings.recycle_after_jobs,
        keep=Limits(
            bytes=settings.result_limit_bytes,
            seconds=settings.result_days * 86400,
            free_bytes=settings.disk_reserve_bytes,
        ),
        assets_bytes_limit=settings.asset_limit_bytes,
        time_limit_seconds=settings.time_limit_seconds,
        memory_limit_bytes=settings.memory_limit_bytes,
        gl=settings.gl,
        native_cpu=settings.native_cpu,
    )


def _openapi(app: FastAPI) -> dict[str, Any]:
    if app.openapi_schema is None:
        app.openapi_schema = document(app)
    return app.openapi_schema
