"""A picture round a pole."""

from typing import ClassVar, Literal

from pydantic import Field

from api_schemas.base import Coordinate, Length
from api_schemas.families import CoordinatesSpec
from api_schemas.frames import Frame


class CylindricalSpec(CoordinatesSpec):
    """The angle round an axis and the height along it, as a label lies round a can.

    Text reads from outside.
    """

    source: ClassVar[str] = "Hughes et al., 2013, sections 20.1 and 20.5"
    equation: ClassVar[str] = "axis z: u = atan2(y, x) / 2 pi, v = clamp((z - base) / height, 0, 1)"
    dimensions: ClassVar[Literal[2, 3]] = 2

    technique: Literal["cylindrical"]
    axis: Literal["x", "y", "z"] = Field(
        default="y",
        description="What the picture is wrapped round. u begins at y, x and x for x, y and z.",
    )
    base: Coordinate = Field(
        default=0.0, description="Where along the axis the picture's lower edge is."
    )
    height: Length = Field(
        default=1.0, description="How far up the picture reaches; its edges are drawn out beyond."
    )
    frame: Frame = Field(
        default="object",
        description="Whether the picture moves with the mesh, stands still in the scene, or "
        "follows the eye.",
    )
