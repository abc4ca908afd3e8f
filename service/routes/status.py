"""What the service is doing, for people and for Prometheus."""

from collections.abc import Mapping
from dataclasses import asdict
from typing import Final

from fastapi import APIRouter
from prometheus_client import CONTENT_TYPE_LATEST, CollectorRegistry, Gauge, generate_latest
from starlette.requests import Request
from starlette.responses import Response

from api_schemas.status import QueueStatus, ServiceStatus, SlotStatus, StoreStatus
from api_schemas.version import VERSION
from service.documentation import TEXT, Responses
from service.engine_access import Engine
from worker.jobs.status import Status

router = APIRouter()

EXPOSITION: Final[Responses] = {
    200: {
        "description": "The text format of Prometheus.",
        "content": {"text/plain": {"schema": TEXT}},
    }
}


@router.get(
    "/v1/status",
    operation_id="get_status",
    summary="What is it doing?",
    tags=["health"],
    response_model=ServiceStatus,
)
def get_status(engine: Engine) -> Response:
    """The queue, the workers and the store, at this moment."""
    status = engine.status()
    told = ServiceStatus(
        version=VERSION,
        uptime_seconds=status.uptime_seconds,
        draining=status.draining,
        fingerprint=status.fingerprint,
        typical_seconds=status.typical_seconds,
        queues={name: QueueStatus(**asdict(queue)) for name, queue in status.queues.items()},
        slots=[
            SlotStatus(
                name=slot.name,
                warm=slot.is_warm,
                jobs_done=slot.jobs_done,
                technique=slot.technique,
                attempt=slot.attempt,
                seconds=slot.seconds,
            )
            for slot in status.slots
        ],
        store=StoreStatus(**asdict(status.store)),
    )
    return Response(
        told.model_dump_json(indent=2) + "\n",
        headers={"Cache-Control": "no-store"},
        media_type="application/json",
    )


@router.get(
    "/metrics",
    operation_id="get_metrics",
    summary="Meters for Prometheus",
    tags=["health"],
    response_class=Response,
    responses=EXPOSITION,
)
def get_metrics(request: Request, engine: Engine) -> Response:
    """Requests, the queue, times by technique, workers replaced and why, cache hits, bytes."""
    registries = (engine.meters.registry, request.app.state.requests.registry)
    text = b"".join(map(generate_latest, (*registries, _gauges(engine.status()))))
    return Response(
        text, headers={"Cache-Control": "no-store", "Content-Type": CONTENT_TYPE_LATEST}
    )


def _gauges(status: Status) -> CollectorRegistry:
    """What is not counted but looked up."""
    registry = CollectorRegistry()

    def gauge(name: str, description: str, values: Mapping[str, float], label: str) -> None:
        meter = Gauge(f"texloom_{name}", description, (label,), registry=registry)
        for key, value in values.items():
            meter.labels(key).set(value)

    queues = status.queues.items()
    by = "priority"
    gauge("queue_depth", "Work that waits.", {name: one.queued for name, one in queues}, by)
    gauge(
        "queue_oldest_seconds",
        "How long the first in line has waited.",
        {name: one.oldest_seconds for name, one in queues},
        by,
    )
    gauge("work_running", "Work being done.", {name: one.running for name, one in queues}, by)
    warm = sum(slot.is_warm for slot in status.slots)
    busy = sum(slot.technique is not None for slot in status.slots)
    slots = {"all": len(status.slots), "warm": warm, "busy": busy}
    gauge("slots", "Workers.", slots, "state")
    gauge(
        "store_bytes",
        "What is on the disk, and free there.",
        {
            "results": status.store.result_bytes,
            "assets": status.store.asset_bytes,
            "free": status.store.free_bytes,
        },
        "what",
    )
    return registry
