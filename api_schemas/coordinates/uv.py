"""The coordinates that come with the mesh."""

from typing import Annotated, ClassVar, Literal

from pydantic import Field

from api_schemas.base import WHOLE
from api_schemas.families import CoordinatesSpec


class UvSpec(CoordinatesSpec):
    """The mesh's own texture coordinates: u to the right, v up."""

    source: ClassVar[str] = "Catmull, 1974"
    equation: ClassVar[str] = "(u, v) interpolated perspective-correctly over each triangle"
    dimensions: ClassVar[Literal[2, 3]] = 2

    technique: Literal["uv"]
    set: Annotated[int, Field(ge=0, le=3), WHOLE] = Field(
        default=0,
        description="Which set of the mesh's coordinates; its first one where it has no such set.",
    )
