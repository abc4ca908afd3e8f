"""Whether the service lives, and whether it can work."""

from typing import Annotated, Literal

from fastapi import APIRouter
from pydantic import Field
from starlette.requests import Request

from api_schemas.base import Schema
from service.documentation import problems
from service.engine_access import Engine
from service.problems import ProblemError

router = APIRouter(tags=["health"])

Count = Annotated[int, Field(ge=0)]


class Alive(Schema):
    """The process answers."""

    status: Literal["alive"] = "alive"


class Ready(Schema):
    """The service takes work."""

    status: Literal["ready"] = "ready"
    slots: Count = Field(description="Jobs that can be done at a time.")
    warm_slots: Count = Field(description="Workers that have compiled everything.")
    queued: Count = Field(description="Jobs that wait.")
    running: Count = Field(description="Jobs being done.")
    fingerprint: str | None = Field(
        description="The platform the pictures are made on; equal ones give equal bytes."
    )


@router.get("/livez", operation_id="livez", summary="Is it alive?")
async def livez() -> Alive:
    """Answers whenever the process does."""
    return Alive()


@router.get(
    "/readyz",
    operation_id="readyz",
    summary="Can it work?",
    responses=problems("not_ready", "draining"),
)
def readyz(request: Request, engine: Engine) -> Ready:
    """503 until a worker is warm, and again while the service stops."""
    facts = engine.ready()
    if facts.draining:
        raise ProblemError("draining", headers={"Retry-After": "5"})
    if not facts.warm_slots:
        raise ProblemError("not_ready", "the workers are compiling", headers={"Retry-After": "1"})
    return Ready(
        slots=facts.slots,
        warm_slots=facts.warm_slots,
        queued=facts.queued,
        running=facts.running,
        fingerprint=facts.fingerprint,
    )
