"""A picture thrown at a thing from all six sides."""

from typing import Annotated, ClassVar, Literal

from pydantic import Field

from api_schemas.families import CoordinatesSpec
from api_schemas.frames import Frame


class TriplanarSpec(CoordinatesSpec):
    """Projections along x, y and z, blended by how much the surface faces each.

    For what has no coordinates of its own. Text reads from outside on every side; one tile is one
    unit of length.
    """

    source: ClassVar[str] = "Geiss, GPU Gems 3, 2007"
    equation: ClassVar[str] = "sum w_i f(projection i), w = |n|^k / sum |n|^k"
    dimensions: ClassVar[Literal[2, 3]] = 2

    technique: Literal["triplanar"]
    sharpness: Annotated[float, Field(ge=0, le=64)] = Field(
        default=4.0,
        description="k: how narrow the bands are in which two projections are seen at once. 0 "
        "blends all three everywhere.",
    )
    frame: Frame = Field(
        default="object",
        description="Whether the picture moves with the mesh, stands still in the scene, or "
        "follows the eye.",
    )
