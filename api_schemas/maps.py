"""A map: a texture put in the place of a surface parameter, and how it is looked up."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Annotated, Final, Literal, TypeAlias, get_args

from pydantic import Field
from typing_extensions import TypeAliasType

from api_schemas.base import Angle, Color, NonNegative, Number, Pair, Schema
from api_schemas.families import Meaning, Wrap
from api_schemas.members import Coordinates, Layout, Texture, mappable

MAPS_MAX = 24
"""Maps on one surface: with eight to spare, what OpenGL lets a shader read."""

FineDetail = Literal["lost", "roughness", "streaks"]
PictureFilter = Literal["nearest", "bilinear", "trilinear", "anisotropic"]
TableFilter = Literal["ripmap", "summed_area"]
Filter = Literal[PictureFilter, "ewa", TableFilter, "formula"]
Pyramid = Literal["box", "kaiser"]
TABLE_FILTERS: Final[tuple[TableFilter, ...]] = get_args(TableFilter)
"""Filters that read a table of their own in the place of smaller levels."""
TABLE_SIDE_MAX: Final = 8180
"""Texels along a side of a picture whose table still fits into OpenGL's largest texture; of an axis
that is stored with its mirrored copy, and the sums' two halves on top of each other, half of it."""


@dataclass(frozen=True, slots=True)
class Slot:
    """Marks a field that takes a texture: whether it is read as colour or as plain data.

    What is wanted in space, as a volume, its technique makes itself, and not as a picture.
    """

    meaning: Meaning
    in_space: bool = False


COLOUR = Slot("colour")
DATA = Slot("data")
DATA_IN_SPACE = Slot("data", in_space=True)


class TextureTransform(Schema):
    """Moves the picture on the surface: coordinates are scaled, then turned, then shifted."""

    offset: Pair = Field(
        default=[0.0, 0.0], description="Shift of the coordinates in tiles, u then v."
    )
    rotation: Angle = Field(
        default=0.0, description="Counter-clockwise turn of the coordinates in radians."
    )
    scale: Pair = Field(
        default=[1.0, 1.0], description="How many tiles fit where one did, along u and v."
    )


class Map(Schema):
    """What all maps share: where to look, and how texels become a pixel."""

    coordinates: Coordinates = Field(
        default={"technique": "uv"},
        validate_default=True,
        description="Where on the texture to look.",
    )
    layout: Layout | None = Field(
        default=None,
        description="How directions lie on the picture, where the coordinates are a direction. The "
        "picture's edges then join as the layout has them, whatever wrap says.",
    )
    transform: TextureTransform = Field(
        default=TextureTransform(), description="Moves, turns and repeats the picture."
    )
    wrap: Annotated[list[Wrap], Field(min_length=2, max_length=2)] = Field(
        default=["repeat", "repeat"],
        description="What lies beyond the tile along u and v: copies, mirrored copies, the edge "
        "drawn out, or border_color.",
    )
    border_color: Annotated[list[Number], Field(min_length=4, max_length=4)] = Field(
        default=[0.0, 0.0, 0.0, 0.0],
        description="Linear value beyond the tile where wrap is border: red, green, blue, alpha.",
    )
    filter: Filter = Field(
        default="anisotropic",
        description="How texels become a pixel: hard texels (nearest), smooth when near "
        "(bilinear), smooth when far (trilinear), sharp at grazing angles too (anisotropic); an "
        "elliptical Gaussian, even and slow (ewa); or the mean of the upright rectangle round the "
        "pixel, from pictures shrunk along u and v each on their own (ripmap), or from sums, "
        "exactly (summed_area). A picture for the last two has at most 8180 texels a side, 4090 "
        "along a v that summed_area mirrors. formula makes no picture: a texture that has a "
        "formula is worked out at every pixel, repeated in all directions, with detail without "
        "end.",
    )
    pyramid: Pyramid = Field(
        default="box",
        description="How smaller levels are made for trilinear, anisotropic and ewa: plain means, "
        "or a Kaiser-windowed sinc, which is sharper in the distance and overshoots a little.",
    )

    @property
    def units(self) -> int:
        """How many of OpenGL's texture units it takes."""
        return 1


class ScaledMap(Map):
    """What is read of it is scaled and shifted."""

    scale: Number = Field(default=1.0, description="Multiplies what is read.")
    bias: Number = Field(default=0.0, description="Is added after the scale.")


class ColorMap(ScaledMap):
    """A texture in the place of a colour; one channel becomes a grey."""

    texture: Annotated[Texture, COLOUR] = Field(description="The picture, of any technique.")
    tint: Color = Field(
        default=[1.0, 1.0, 1.0], description="Linear colour that multiplies what is read."
    )


class LightMap(ColorMap):
    """Light that was baked into a picture, mostly on a second set of coordinates."""

    coordinates: Coordinates = Field(
        default={"technique": "uv", "set": 1},
        validate_default=True,
        description="Where on the texture to look.",
    )


class NumberMap(ScaledMap):
    """A texture in the place of a number: one channel of it, never gamma-decoded."""

    texture: Annotated[Texture, DATA] = Field(description="The picture, of any technique.")
    channel: Literal["r", "g", "b", "a", "packed"] = Field(
        default="r",
        description="Which channel of the texture is read; packed takes all four as the bytes of "
        "one number, as `pack_float` writes them, before anything is blended.",
    )


class DensityMap(NumberMap):
    """A texture in the place of a density: in space, unless its coordinates say otherwise."""

    coordinates: Coordinates = Field(
        default={"technique": "position"},
        validate_default=True,
        description="Where on the texture to look. What is no place in space is that of where the "
        "ray enters.",
    )
    filter: Filter = Field(
        default="trilinear",
        description="How texels become a point of the ray: anisotropic is slow, formula slower.",
    )


class NormalMap(Map):
    """A texture in the place of a normal: x, y, z along tangent, bitangent and normal.

    The tangent points where u grows, the bitangent where v grows; in object space x, y, z are those
    of the shape itself.
    """

    texture: Annotated[Texture, DATA] = Field(description="The picture, of any technique.")
    strength: Number = Field(
        default=1.0, description="Multiplies the tilt: 0 is flat, negative turns it round."
    )
    green: Literal["up", "down"] = Field(
        default="up",
        description="Whether green grows with v, as in OpenGL and glTF, or against it.",
    )
    range: Literal["unit", "signed"] = Field(
        default="unit",
        description="Whether the picture holds 0..1, with 0.5 for none, or the numbers themselves.",
    )
    fine_detail: FineDetail = Field(
        default="lost",
        description="What becomes of tilts that are finer than a pixel: lost, so that far things "
        "sparkle or look polished, or roughness, which makes highlights wider and dimmer, as all "
        "the small ones together are (Toksvig, 2005), or streaks, which makes them so in the "
        "directions that the small ones lean to, as grooves do (Olano and Baker, 2010). Surfaces "
        "whose highlights are always round, and normals in object space, take roughness for "
        "streaks.",
    )
    space: Literal["tangent", "object"] = Field(
        default="tangent",
        description="Whether the normals lean from the surface or are the shape's own, which need "
        "no directions of u and v and ignore how the picture is turned.",
    )

    @property
    def units(self) -> int:
        """Streaks need the products of slopes as well."""
        return 2 if self.fine_detail == "streaks" else 1


if TYPE_CHECKING:
    MappableNumber: TypeAlias = float | NumberMap
    MappableNonNegative: TypeAlias = float | NumberMap
    MappableDensity: TypeAlias = float | DensityMap
    MappableColor: TypeAlias = list[float] | ColorMap
else:
    MappableNumber = TypeAliasType("MappableNumber", mappable(Number, NumberMap))
    MappableNonNegative = TypeAliasType("MappableNonNegative", mappable(NonNegative, NumberMap))
    MappableDensity = TypeAliasType("MappableDensity", mappable(NonNegative, DensityMap))
    MappableColor = TypeAliasType("MappableColor", mappable(Color, ColorMap))
