"""What a mirrored ball shows from far away."""

from typing import ClassVar, Literal

from api_schemas.families import LayoutSpec


class MirrorBallSpec(LayoutSpec):
    """A photograph of a mirrored ball, taken from +z and cut to the ball.

    The middle shows the camera, the rim what is behind the ball; equal areas are equal solid
    angles.
    """

    source: ClassVar[str] = "Miller and Hoffman, 1984"
    equation: ClassVar[str] = "(u, v) = 1/2 + (x, y) / (2 sqrt(2 (1 + z)))"
    whole: ClassVar[bool] = False

    technique: Literal["mirror_ball"]
