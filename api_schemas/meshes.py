"""Shapes with documented texture coordinates; text on a texture reads upright on each."""

import math
from typing import Annotated, Literal

from pydantic import Field

from api_schemas.base import WHOLE, Length, Schema
from api_schemas.model_mesh import ModelMesh

Count = Annotated[int, Field(ge=1, le=4096), WHOLE]
RoundCount = Annotated[int, Field(ge=3, le=4096), WHOLE]
Facing = Literal["+z", "+y"]


class Cylinder(Schema):
    """A can standing on y = 0: u runs round it counter-clockwise seen from above, v runs up.

    Caps, where asked for, show the texture's inscribed disc, upright seen from outside.
    """

    type: Literal["cylinder"]
    radius: Length = Field(default=1.0, description="Half its width.")
    height: Length = Field(default=2.0, description="From y = 0 to its upper rim.")
    segments: RoundCount = Field(default=64, description="Flat sides round the axis.")
    rows: Count = Field(default=1, description="Bands along the axis.")
    caps: bool = Field(default=False, description="Close both ends.")

    @property
    def triangles(self) -> int:
        """How many triangles the mesh has."""
        return 2 * self.segments * self.rows + (2 * self.segments if self.caps else 0)

    @property
    def reach(self) -> float:
        """Radius of a ball round the origin that holds the mesh."""
        return math.hypot(self.radius, self.height)


class Sphere(Schema):
    """A globe with its poles on y: u runs along the equator, v from south to north."""

    type: Literal["sphere"]
    radius: Length = Field(default=1.0, description="Half its width.")
    segments: RoundCount = Field(default=64, description="Meridians.")
    rings: Annotated[int, Field(ge=2, le=2048), WHOLE] = Field(
        default=32, description="Bands from pole to pole."
    )
    flip_u: bool = Field(
        default=True,
        description="Text reads from outside, as on a globe; without it from inside, as on a sky.",
    )

    @property
    def triangles(self) -> int:
        """How many triangles the mesh has."""
        return 2 * self.segments * (self.rings - 1)

    @property
    def reach(self) -> float:
        """Radius of a ball round the origin that holds the mesh."""
        return self.radius


class Plane(Schema):
    """A rectangle in the middle of the world: u along its width, v along its height."""

    type: Literal["plane"]
    width: Length = Field(default=2.0, description="Extent along x.")
    height: Length = Field(default=2.0, description="Extent along y, or along -z when it faces +y.")
    facing: Facing = Field(
        default="+z", description="Standing like a poster, or lying like a floor."
    )

    @property
    def triangles(self) -> int:
        """How many triangles the mesh has."""
        return 2

    @property
    def reach(self) -> float:
        """Radius of a ball round the origin that holds the mesh."""
        return math.hypot(self.width, self.height) / 2


class Box(Schema):
    """A box round the origin; each face shows the whole texture upright.

    The top and the bottom are upright for somebody who stands in front (at +z).
    """

    type: Literal["box"]
    width: Length = Field(default=2.0, description="Extent along x.")
    height: Length = Field(default=2.0, description="Extent along y.")
    depth: Length = Field(default=2.0, description="Extent along z.")

    @property
    def triangles(self) -> int:
        """How many triangles the mesh has."""
        return 12

    @property
    def reach(self) -> float:
        """Radius of a ball round the origin that holds the mesh."""
        return math.hypot(self.width, self.height, self.depth) / 2


class Torus(Schema):
    """A ring round the y axis: u runs round the axis, v round the tube."""

    type: Literal["torus"]
    radius: Length = Field(default=1.0, description="From the axis to the middle of the tube.")
    tube_radius: Length = Field(default=0.4, description="Half the thickness of the tube.")
    segments: RoundCount = Field(default=96, description="Sections round the axis.")
    rings: RoundCount = Field(default=48, description="Sections round the tube.")

    @property
    def triangles(self) -> int:
        """How many triangles the mesh has."""
        return 2 * self.segments * self.rings

    @property
    def reach(self) -> float:
        """Radius of a ball round the origin that holds the mesh."""
        return self.radius + self.tube_radius


class Disk(Schema):
    """A flat disc showing the texture's inscribed circle: u to the right, v up."""

    type: Literal["disk"]
    radius: Length = Field(default=1.0, description="Half its width.")
    segments: RoundCount = Field(default=64, description="Corners of its rim.")
    facing: Facing = Field(
        default="+z", description="Standing like a poster, or lying like a floor."
    )

    @property
    def triangles(self) -> int:
        """How many triangles the mesh has."""
        return self.segments

    @property
    def reach(self) -> float:
        """Radius of a ball round the origin that holds the mesh."""
        return self.radius


class InfinitePlane(Schema):
    """A ground to the horizon, or a wall without end: its texture is repeated for ever.

    The camera's far plane does not cut it. A camera that frames what there is frames the other
    things, or a few tiles round the origin.
    """

    type: Literal["infinite_plane"]
    tile: Annotated[list[Length], Field(min_length=2, max_length=2)] = Field(
        default=[1.0, 1.0],
        description="Extent of one texture along its u and v; one has its lower left corner in the "
        "origin.",
    )
    facing: Facing = Field(default="+y", description="Standing like a wall, or lying like a floor.")

    @property
    def triangles(self) -> int:
        """How many triangles the mesh has."""
        return 1

    @property
    def reach(self) -> float:
        """Radius of a ball round the origin that holds the mesh: there is none."""
        return math.inf


Primitive = Cylinder | Sphere | Plane | Box | Torus | Disk | InfinitePlane
"""A shape made from numbers alone."""

Mesh = Annotated[Primitive | ModelMesh, Field(discriminator="type")]
