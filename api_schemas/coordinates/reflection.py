"""What is seen in a mirror."""

from typing import ClassVar, Literal

from pydantic import Field

from api_schemas.families import CoordinatesSpec
from api_schemas.frames import Frame


class ReflectionSpec(CoordinatesSpec):
    """The direction that a mirror shows: the view, reflected at the normal.

    With a layout, a picture of all directions is reflected as if it were infinitely far away.
    """

    source: ClassVar[str] = "Blinn and Newell, 1976"
    equation: ClassVar[str] = "r = 2 (n.v) n - v, with v towards the eye"

    technique: Literal["reflection"]
    frame: Frame = Field(
        default="world",
        description="Whether the picture stands still in the scene, turns with the mesh, or "
        "follows the eye.",
    )
