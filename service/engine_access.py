"""The engine and the settings, as routes ask for them."""

from typing import Annotated

from fastapi import Depends
from starlette.requests import Request

from api_schemas.assets import ASSET_FACTS, AssetFacts
from service.settings import Settings
from worker.jobs.queue import JobQueue


async def engine(request: Request) -> JobQueue:
    """Return the engine of the running service."""
    found: JobQueue = request.app.state.engine
    return found


async def settings(request: Request) -> Settings:
    """Return the settings of the running service."""
    found: Settings = request.app.state.settings
    return found


Engine = Annotated[JobQueue, Depends(engine)]
Configuration = Annotated[Settings, Depends(settings)]


def asset_facts(engine: JobQueue, tenant: str, sha256: str) -> AssetFacts | None:
    """Return what was measured of one of the tenant's assets."""
    asset = engine.assets.get(tenant, sha256)
    return None if asset is None else ASSET_FACTS.validate_python(asset.facts)
