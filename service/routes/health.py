"""Whether the service lives, and whether it can work."""

from fastapi import APIRouter
from starlette.requests import Request

from api_schemas.health import Alive, Ready
from service.documentation import problems
from service.engine_access import Engine
from service.problems import ProblemError

router = APIRouter(tags=["health"])


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
