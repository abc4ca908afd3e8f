"""Where the eye looks."""

from typing import ClassVar, Literal

from pydantic import Field

from api_schemas.families import CoordinatesSpec
from api_schemas.frames import Frame


class ViewSpec(CoordinatesSpec):
    """The direction from the eye to the point.

    With a layout, a picture of all directions is seen through the surface as through a window.
    """

    source: ClassVar[str] = "Hughes et al., 2013, section 20.5"
    equation: ClassVar[str] = "(P - E) / |P - E|"

    technique: Literal["view"]
    frame: Frame = Field(
        default="world",
        description="Whether the picture stands still in the scene, turns with the mesh, or "
        "follows the eye.",
    )
