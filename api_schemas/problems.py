"""How every refusal looks: RFC 9457 problem details with a code that never changes."""

from typing import Annotated

from pydantic import Field

from api_schemas.base import NonNegative, Schema

Code = Annotated[str, Field(pattern="^[a-z][a-z0-9_]*$", max_length=64)]
PROBLEMS_MAX = 100
"""How much is told at once."""
Pointer = Annotated[str, Field(max_length=4096)]


class CostFigures(Schema):
    """Time and memory."""

    seconds: NonNegative = Field(description="Seconds on one core.")
    bytes: NonNegative = Field(description="Bytes of memory at the peak.")


class Obstruction(Schema):
    """One thing that is wrong, and where."""

    code: Code = Field(description="What is wrong, for programs.")
    pointer: Pointer = Field(
        description="JSON pointer into the request body: the value that is wrong, or the key that "
        "is missing. Empty for the whole body."
    )
    message: str = Field(description="What is wrong and what would be right, for people.")


class JobFailure(Schema):
    """Why a job did not succeed."""

    code: Code = Field(description="What went wrong, for programs.")
    message: str = Field(description="What went wrong, for people.")
    pointer: Pointer | None = Field(
        default=None, description="JSON pointer into the request body, where one value is to blame."
    )


class Problem(Schema):
    """Why a request was refused. Nothing of the request itself is repeated, except key names."""

    type: str = Field(description="The code as a URN.")
    title: str = Field(description="What the code means.")
    status: Annotated[int, Field(ge=400, le=599)] = Field(description="The HTTP status.")
    code: Code = Field(description="What is wrong, for programs; it never changes.")
    detail: str | None = Field(default=None, description="What is wrong this time, for people.")
    instance: str | None = Field(default=None, description="The job it is about.")
    pointer: Pointer | None = Field(
        default=None, description="JSON pointer into the request body, where one value is to blame."
    )
    problems: Annotated[list[Obstruction], Field(max_length=PROBLEMS_MAX)] | None = Field(
        default=None, description="Everything that is wrong, as far as one can tell at once."
    )
    estimate: CostFigures | None = Field(
        default=None, description="What the request would take, when that is too much."
    )
    limit: CostFigures | None = Field(default=None, description="What it may take at most.")
    failure: JobFailure | None = Field(
        default=None, description="The job's own problem, when it has failed."
    )
