"""The direction a surface faces."""

from typing import ClassVar, Literal

from pydantic import Field

from api_schemas.families import CoordinatesSpec
from api_schemas.frames import Frame


class NormalSpec(CoordinatesSpec):
    """The normal, on the eye's side and tilted by a normal map, as a direction.

    With a layout, a picture of all directions is seen as if painted on the surface: irradiance maps
    are looked up so. Without one, its x and y are, as pictures of a lit ball are: with frame view,
    scale 1/2 and offset 1/2.
    """

    source: ClassVar[str] = "Hughes et al., 2013, section 20.5"
    equation: ClassVar[str] = "n"

    technique: Literal["normal"]
    frame: Frame = Field(
        default="world",
        description="Whether the picture stands still in the scene, turns with the mesh, or "
        "follows the eye.",
    )
