"""A job as the API shows it: a request on its way to a picture."""

from typing import Annotated, Any, Literal

from pydantic import AwareDatetime, Field

from api_schemas.base import Link, NonNegative, Schema, Sha256
from api_schemas.output import MediaType
from api_schemas.problems import CostFigures, JobFailure, Obstruction
from api_schemas.requests import Kind, Priority, RenderRequest, TextureRequest

State = Literal["queued", "running", "succeeded", "failed", "cancelled"]
JOB_ID_PATTERN = "^[0-9a-f]{32}$"
CURSOR_PATTERN = "^[0-9a-f]{16}$"
JobId = Annotated[str, Field(pattern=JOB_ID_PATTERN)]


class Result(Schema):
    """The finished file."""

    media_type: MediaType = Field(description="What kind of file it is.")
    bytes: Annotated[int, Field(ge=0)] = Field(description="Its length.")
    sha256: Sha256 = Field(description="SHA-256 of its bytes; also its ETag.")
    width: Annotated[int, Field(ge=1)] = Field(description="Pixels from left to right.")
    height: Annotated[int, Field(ge=1)] = Field(description="Pixels from top to bottom.")
    timings: dict[str, NonNegative] = Field(
        default={}, description="Where the time went: milliseconds by step."
    )
    counts: dict[str, Annotated[int, Field(ge=0)]] = Field(
        default={}, description="What was drawn: triangles, and texels of textures."
    )
    report: dict[str, Any] = Field(
        default={}, description="What the technique found out, in its own words and numbers."
    )
    warnings: list[Annotated[str, Field(max_length=1024)]] = Field(
        default=[], description="What in the uploads could not be honoured, and was left out."
    )


class JobLinks(Schema):
    """Where to go from here."""

    self: Link = Field(description="This job.")
    events: Link = Field(description="What happens to the job, as it happens.")
    cancel: Link = Field(description="DELETE this to cancel the job.")
    preview: Link = Field(
        description="A small picture of how far it is, where the technique shows one."
    )
    result: Link = Field(description="The finished file.")


class Job(Schema):
    """One request, from its arrival to its result."""

    id: JobId = Field(description="The job's name.")
    kind: Kind = Field(description="What is being made.")
    state: State = Field(description="How far it is.")
    priority: Priority = Field(description="Whether somebody waits for it.")
    digest: Sha256 = Field(description="SHA-256 of the request: equal digests, equal pictures.")
    position: Annotated[int, Field(ge=1)] | None = Field(
        description="Place in the queue, 1 being next, while queued."
    )
    attempt: Annotated[int, Field(ge=0)] = Field(
        description="How many times the work was begun: again when a worker was lost."
    )
    progress: Annotated[float, Field(ge=0, le=1)] = Field(description="From 0 to 1.")
    stage: str | None = Field(description="What is being done, while running.")
    eta_seconds: NonNegative | None = Field(
        description="Seconds until it is finished, going by how long the last jobs of its kind "
        "took; unknown when it is, and before there were any."
    )
    created: AwareDatetime = Field(description="When the request arrived.")
    started: AwareDatetime | None = Field(
        description="When the work began: before the request, where an equal one had been made."
    )
    finished: AwareDatetime | None = Field(description="When the job ended, however it ended.")
    result: Result | None = Field(description="The finished file, when succeeded.")
    failure: JobFailure | None = Field(description="What went wrong, when failed.")
    links: JobLinks = Field(description="Where to go from here.")


class JobPage(Schema):
    """Jobs, newest first."""

    jobs: list[Job] = Field(description="The jobs of this page.")
    next: Link | None = Field(description="The next page, when there are older jobs.")


class Validation(Schema):
    """What would become of a request, without doing it."""

    kind: Kind = Field(description="What it asks for.")
    possible: bool = Field(description="Whether it would be accepted, if there were room for it.")
    problems: list[Obstruction] = Field(description="What stands in the way.")
    estimate: CostFigures = Field(description="What it would take.")
    limit: CostFigures = Field(description="What it may take at most.")
    digest: Sha256 | None = Field(
        description="SHA-256 of the request; unknown while an asset is missing."
    )
    normalised: TextureRequest | RenderRequest | None = Field(
        description="The request with every default filled in and nothing left to guess."
    )
