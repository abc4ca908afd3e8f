"""The coordinates that come with the mesh, interpolated as early hardware did."""

from typing import Annotated, ClassVar, Literal

from pydantic import Field

from api_schemas.base import WHOLE
from api_schemas.families import CoordinatesSpec


class AffineUvSpec(CoordinatesSpec):
    """The mesh's own texture coordinates as if each triangle were a flat picture: to learn from.

    Without the division by depth, textures bend along the edges of triangles seen in perspective.
    """

    source: ClassVar[str] = "Heckbert and Moreton, 1991 (what it lacks); Hughes et al., 2013, 20.1"
    equation: ClassVar[str] = (
        "(u, v) = sum l_i (u, v)_i with barycentric coordinates l on the screen; right is "
        "sum (l_i / w_i) (u, v)_i / sum (l_i / w_i)"
    )
    dimensions: ClassVar[Literal[2, 3]] = 2

    technique: Literal["affine_uv"]
    set: Annotated[int, Field(ge=0, le=3), WHOLE] = Field(
        default=0,
        description="Which set of the mesh's coordinates; its first one where it has no such set.",
    )
