"""Fine detail of a surface: maps that tilt it, raise it or let it look deep, and real geometry."""

from __future__ import annotations

from typing import Annotated, Literal, TypeAlias

from pydantic import Field

from api_schemas.base import WHOLE, Coordinate, Length, Number
from api_schemas.maps import DATA, ColorMap, FineDetail, Map, NormalMap, NumberMap
from api_schemas.members import Texture

DISPLACED_TRIANGLES_MAX = 2**21
"""Triangles of one mesh after subdivision."""
_USUAL_TRIANGLES = 2**18
_LEVELS_MAX = 10

Channel = Literal["r", "g", "b", "a"]
BumpEncoding = Literal["snorm8", "unorm8", "float"]
TangentFrames = Literal["mikktspace", "averaged", "sphere"]


class BumpMap(Map):
    """A texture that tilts the surface: red along u, green along v, as parts of the normal."""

    texture: Annotated[Texture, DATA] = Field(
        description="The picture, of any technique: two channels are read; one tilts along both."
    )
    encoding: BumpEncoding = Field(
        default="unorm8",
        description="How a texel means -1..1: a signed byte in two's complement (128 and 129 are "
        "both -1), an unsigned byte from 0 (-1) to 255 (1), which has no exact 0, or the number "
        "itself.",
    )
    range: Number = Field(
        default=1.0,
        description="Tilt that a full value means: 1 is 45 degrees along one axis; negative turns "
        "bumps into dents.",
    )
    fine_detail: FineDetail = Field(
        default="lost",
        description="What becomes of tilts that are finer than a pixel: lost, so that far things "
        "sparkle or look polished, or roughness, which makes highlights wider and dimmer, as all "
        "the small ones together are (Olano and Baker, 2010), or streaks, which makes them so in "
        "the directions that the small ones lean to, as grooves do. Surfaces whose highlights are "
        "always round take roughness for streaks.",
    )

    @property
    def units(self) -> int:
        """Streaks need the products of slopes as well."""
        return 2 if self.fine_detail == "streaks" else 1


class ReliefMap(Map):
    """A texture read as heights."""

    texture: Annotated[Texture, DATA] = Field(
        description="The relief, of any technique: bright is high."
    )
    channel: Channel = Field(default="r", description="Which channel of the texture is read.")


class HeightMap(ReliefMap):
    """A relief that is seen in the light only: it tilts the surface as its slopes do."""

    depth: Coordinate = Field(
        default=0.05,
        description="How high a value of 1 stands, in the shape's own units: negative turns bumps "
        "into dents.",
    )
    middle: Number = Field(
        default=0.0,
        description="The value that lies on the surface itself; only exact slopes depend on it.",
    )
    method: Literal["exact", "blinn"] = Field(
        default="exact",
        description="Whether slopes of what stands out of a round surface are those of the larger "
        "surface out there, or those of a thin skin.",
    )
    fine_detail: FineDetail = Field(
        default="lost",
        description="What becomes of slopes that are finer than a pixel, those of a thin skin: "
        "lost, roughness or streaks, as of a bump map.",
    )

    @property
    def units(self) -> int:
        """Whatever becomes of fine slopes needs their products."""
        return 1 if self.fine_detail == "lost" else 2


class ParallaxMap(ReliefMap):
    """A relief below the surface that the eye looks into: maps shift by what hides what."""

    depth: Annotated[float, Field(ge=0, le=1e6)] = Field(
        default=0.05,
        description="How deep a value of 0 lies below the surface, in the shape's own units; 1 "
        "lies on it.",
    )
    method: Literal["offset", "occlusion"] = Field(
        default="occlusion",
        description="One shift by the height seen, cheap and right for gentle reliefs, or a walk "
        "along the ray, where near parts hide far ones.",
    )
    steps: Annotated[int, Field(ge=1, le=128), WHOLE] = Field(
        default=32, description="Steps of the walk: few show layers at grazing angles."
    )


class Displacement(ReliefMap):
    """A relief made of real triangles: outlines and shadows have it too.

    Edges are cut in halves, each corner is moved along its normal, corners at one place together.
    """

    depth: Coordinate = Field(
        default=0.1,
        description="How far a value of 1 moves a point outwards, in the shape's own units.",
    )
    middle: Number = Field(default=0.0, description="The value that leaves a point in place.")
    subdivisions: Annotated[int, Field(ge=0, le=_LEVELS_MAX), WHOLE] | None = Field(
        default=None,
        description="How often edges are halved: each time makes four triangles of one. Without "
        "it, as often as a quarter of a million triangles allow.",
    )
    longest_edge: Length | None = Field(
        default=None,
        description="Edges no longer than this, in the shape's own units, are not halved: fine "
        "meshes then grow less.",
    )

    def levels(self, triangles: int) -> int:
        """Return how often edges of a mesh of so many triangles are halved at most."""
        if self.subdivisions is not None:
            return self.subdivisions
        fitting = _USUAL_TRIANGLES // max(triangles, 1)
        return min(max(fitting.bit_length() - 1, 0) // 2, _LEVELS_MAX)

    def triangles(self, before: int) -> int:
        """Return how many triangles become of so many, at most."""
        return before << 2 * self.levels(before)


AnyMap: TypeAlias = ColorMap | NumberMap | NormalMap | BumpMap | ReliefMap
"""A map with its texture, whatever that is read as."""
