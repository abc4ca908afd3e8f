"""Many requests at once: listed one by one, or one request swept over values."""

from typing import Annotated, Any, Literal

from pydantic import AwareDatetime, Discriminator, Field, JsonValue, Tag

from api_schemas.base import Link, Schema, Sha256
from api_schemas.jobs import JobId, Result, State
from api_schemas.problems import JobFailure
from api_schemas.requests import Kind, RenderRequest, TextureRequest

ITEMS_MAX = 1000
AXES_MAX = 8
BATCH_ID_PATTERN = "^[0-9a-f]{32}$"


def _kind(value: Any) -> Kind:
    """What brings a scene is to be rendered; everything else is judged as a texture."""
    is_render = "scene" in value if isinstance(value, dict) else isinstance(value, RenderRequest)
    return "render" if is_render else "texture"


Item = Annotated[
    Annotated[TextureRequest, Tag("texture")] | Annotated[RenderRequest, Tag("render")],
    Discriminator(_kind),
]
"""The body of a request for a texture or a render; without a priority it is batch work here."""


class ListedBatch(Schema):
    """Requests one by one, textures and renders as they come."""

    items: Annotated[list[Item], Field(min_length=1, max_length=ITEMS_MAX)] = Field(
        description="The requests. One that names no priority has that of batch work here."
    )


class Axis(Schema):
    """One thing that varies."""

    pointer: Annotated[str, Field(pattern="^(/([^~/]|~[01])*)+$", max_length=1024)] = Field(
        description="JSON pointer into the request: what the values take the place of. It has to "
        "be there, written or as a default."
    )
    values: Annotated[list[JsonValue], Field(min_length=1, max_length=ITEMS_MAX)] = Field(
        description="What to put there, one after another."
    )


class Sweep(Schema):
    """What varies, and how the values of several axes come together."""

    mode: Literal["grid", "zip"] = Field(
        default="grid",
        description="grid: every value with every other, those of the last axis changing fastest; "
        "zip: the first of each, the second of each and so on, from lists of equal length.",
    )
    axes: Annotated[list[Axis], Field(min_length=1, max_length=AXES_MAX)] = Field(
        description="The things that vary."
    )


class SweptBatch(Schema):
    """One request, made again and again with other values in some places."""

    request: Item = Field(
        description="The request. If it names no priority it has that of batch work here."
    )
    sweep: Sweep = Field(description="What varies.")


class Counts(Schema):
    """How many jobs are in each state."""

    queued: Annotated[int, Field(ge=0)] = Field(default=0, description="Waiting.")
    running: Annotated[int, Field(ge=0)] = Field(default=0, description="Under way.")
    succeeded: Annotated[int, Field(ge=0)] = Field(default=0, description="Done.")
    failed: Annotated[int, Field(ge=0)] = Field(default=0, description="Gone wrong.")
    cancelled: Annotated[int, Field(ge=0)] = Field(default=0, description="Called off.")


class BatchLinks(Schema):
    """Where to go from here."""

    self: Link = Field(description="This batch.")
    cancel: Link = Field(description="DELETE this to cancel what is not finished.")
    manifest: Link = Field(description="Every item with its job and its result.")


class Batch(Schema):
    """Many jobs that were asked for at once."""

    id: JobId = Field(description="The batch's name.")
    size: Annotated[int, Field(ge=1)] = Field(description="How many jobs it has.")
    counts: Counts = Field(description="How they are.")
    progress: Annotated[float, Field(ge=0, le=1)] = Field(
        description="From 0 to 1: the mean over its jobs, where what has ended is done."
    )
    created: AwareDatetime = Field(description="When the request arrived.")
    finished: AwareDatetime | None = Field(
        description="When the last job ended, once all have, however they ended."
    )
    links: BatchLinks = Field(description="Where to go from here.")


class BatchPage(Schema):
    """Batches, newest first."""

    batches: list[Batch] = Field(description="The batches of this page.")
    next: Link | None = Field(description="The next page, when there are older batches.")


class EntryLinks(Schema):
    """Where to go from here."""

    job: Link = Field(description="The item's job.")
    result: Link | None = Field(description="The finished file, when succeeded.")


class Entry(Schema):
    """What became of one item."""

    index: Annotated[int, Field(ge=0)] = Field(description="Its place in the batch, from 0.")
    values: dict[str, JsonValue] | None = Field(
        description="The values of a sweep that it was made with, by pointer."
    )
    job: JobId = Field(description="The name of its job.")
    kind: Kind = Field(description="What is being made.")
    state: State = Field(description="How far it is.")
    digest: Sha256 = Field(description="SHA-256 of the request: equal digests, equal pictures.")
    result: Result | None = Field(description="The finished file, when succeeded.")
    failure: JobFailure | None = Field(description="What went wrong, when failed.")
    links: EntryLinks = Field(description="Where to go from here.")


class Manifest(Schema):
    """Everything a batch made, in the order of its items."""

    batch: Batch = Field(description="The batch.")
    items: list[Entry] = Field(description="Its items.")
