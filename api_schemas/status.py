"""What the service is doing right now, for people."""

from typing import Annotated

from pydantic import Field

from api_schemas.base import NonNegative, Schema
from api_schemas.requests import Priority

Count = Annotated[int, Field(ge=0)]


class QueueStatus(Schema):
    """The work of one priority."""

    queued: Count = Field(description="Work that waits.")
    running: Count = Field(description="Work being done.")
    oldest_seconds: NonNegative = Field(description="How long the first in line has waited.")


class SlotStatus(Schema):
    """One worker."""

    name: str = Field(description="The worker's name, as in the log.")
    warm: bool = Field(description="Whether it has compiled everything.")
    jobs_done: Count = Field(description="What it has done since the service started.")
    technique: str | None = Field(description="What it is making, unless it is idle.")
    attempt: Annotated[int, Field(ge=1)] | None = Field(
        description="Which attempt that is: a later one after a worker was lost."
    )
    seconds: NonNegative | None = Field(description="How long it has been at it.")


class StoreStatus(Schema):
    """What is kept on the disk."""

    results: Count = Field(description="Finished files.")
    result_bytes: Count = Field(description="What they take.")
    asset_bytes: Count = Field(description="What uploads take.")
    free_bytes: Count = Field(description="What is free on the disk.")


class ServiceStatus(Schema):
    """Everything at one moment."""

    version: str = Field(description="Of the service.")
    uptime_seconds: NonNegative = Field(description="Since it was started.")
    draining: bool = Field(description="Whether it is stopping.")
    fingerprint: str | None = Field(
        description="The platform the pictures are made on; equal ones give equal bytes."
    )
    typical_seconds: NonNegative = Field(description="What recent work took in the mean.")
    queues: dict[Priority, QueueStatus] = Field(description="The queue, by priority.")
    slots: list[SlotStatus] = Field(description="The workers.")
    store: StoreStatus = Field(description="The files.")
