"""All directions on one disc, by their angle from the middle."""

from typing import ClassVar, Literal

from pydantic import Field

from api_schemas.families import LayoutSpec


class AngularProbeSpec(LayoutSpec):
    """The distance from the middle is the angle from one direction; the rim is the opposite one."""

    source: ClassVar[str] = "Debevec, 1998"
    equation: ClassVar[str] = "-z: (u, v) = 1/2 + (x, y) acos(-z) / (2 pi sqrt(x^2 + y^2))"
    whole: ClassVar[bool] = False

    technique: Literal["angular_probe"]
    centre: Literal["-z", "+z"] = Field(
        default="-z",
        description="Which direction is in the middle. x is to the right either way: with -z the "
        "picture is right as seen from within, with +z it is mirrored.",
    )
