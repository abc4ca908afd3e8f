"""What a lens with a very wide angle sees."""

import math
from typing import Annotated, ClassVar, Literal

from pydantic import Field

from api_schemas.families import LayoutSpec, Wrap

Towards = Literal["-z", "+z", "+x", "-x", "+y", "-y"]


class FisheyeSpec(LayoutSpec):
    """A disc that touches the picture's sides; right as seen from within. Beyond it all is black.

    y is up in the picture; towards +y, z is, and towards -y, -z.
    """

    source: ClassVar[str] = "Miyamoto, 1964; Hughes et al., 2013, section 20.2"
    equation: ClassVar[str] = (
        "r = a equidistant, 2 sin(a/2) equisolid, 2 tan(a/2) stereographic, sin(a) orthographic; "
        "over its value at the rim, a = angle / 2"
    )
    whole: ClassVar[bool] = False

    technique: Literal["fisheye"]
    model: Literal["equidistant", "equisolid", "stereographic", "orthographic"] = Field(
        default="equidistant",
        description="How the lens spreads angles: evenly, by area, with small shapes kept, or as "
        "seen from far away on a ball.",
    )
    angle: Annotated[float, Field(ge=0.01, le=2 * math.pi)] = Field(
        default=math.pi,
        description="Angle from rim to rim in radians: more of the world, drawn smaller. At most "
        "pi if orthographic, and 6.2 if stereographic.",
    )
    towards: Towards = Field(default="-z", description="Where the lens looks.")

    @property
    def joins(self) -> tuple[Wrap, Wrap]:
        """Black, where anything is beyond."""
        return ("border", "border") if self.angle < 2 * math.pi else ("clamp", "clamp")

    def mistake(self) -> tuple[str, str] | None:
        """Some lenses cannot look behind themselves."""
        most = {"orthographic": math.pi, "stereographic": 6.2}.get(self.model, 2 * math.pi)
        if self.angle <= most:
            return None
        return "angle", f"{self.angle:g} is beyond the {most:g} that {self.model} can reach"
