"""What is seen through a transparent thing."""

from typing import Annotated, ClassVar, Literal

from pydantic import Field

from api_schemas.families import CoordinatesSpec
from api_schemas.frames import Frame


class RefractionSpec(CoordinatesSpec):
    """The direction behind a surface that bends light once, as the front of thick glass does.

    Seen from inside, light leaves the glass; beyond the critical angle it is reflected.
    """

    source: ClassVar[str] = "Snell's law; as coordinates of a map: Hughes et al., 2013, table 20.1"
    equation: ClassVar[str] = "sin(i) = ior sin(t)"

    technique: Literal["refraction"]
    ior: Annotated[float, Field(ge=0.1, le=10)] = Field(
        default=1.5,
        description="Index of refraction of what is behind the outer side: how strongly the "
        "picture is bent. 1 bends nothing.",
    )
    frame: Frame = Field(
        default="world",
        description="Whether the picture stands still in the scene, turns with the mesh, or "
        "follows the eye.",
    )
