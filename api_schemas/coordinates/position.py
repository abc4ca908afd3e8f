"""Where a point is, moved by any affine map."""

from typing import Annotated, ClassVar, Literal

from pydantic import Field

from api_schemas.base import Vector
from api_schemas.families import CoordinatesSpec
from api_schemas.frames import Frame

Matrix3 = Annotated[list[Vector], Field(min_length=3, max_length=3)]


class PositionSpec(CoordinatesSpec):
    """The place of the point in space: projections along any direction, globes, solid textures.

    Without a layout, the first two numbers are the place on the picture, which is drawn out along
    the rest of space. With one, the picture is wrapped round the origin: latlong makes a globe,
    whose text reads from outside where the transform's scale is [-1, 1].
    """

    source: ClassVar[str] = "Hughes et al., 2013, section 20.5; Peachey, 1985; Perlin, 1985"
    equation: ClassVar[str] = "t = A x + b"

    technique: Literal["position"]
    frame: Frame = Field(
        default="object",
        description="Whether the texture is carved into the mesh, stands still in the scene, or "
        "follows the eye.",
    )
    matrix: Matrix3 = Field(
        default=[[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
        description="A, row by row: each row says along which direction one coordinate grows, and "
        "how many tiles there are in a unit of length.",
    )
    offset: Vector = Field(
        default=[0.0, 0.0, 0.0], description="b: where on the texture the origin is."
    )
