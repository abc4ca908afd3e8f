"""Whether the service lives and can work, told by itself."""

from typing import Annotated, Literal

from pydantic import Field

from api_schemas.base import Schema

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
