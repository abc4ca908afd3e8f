"""What the finished picture looks like as a file."""

import math
from collections.abc import Mapping
from typing import Annotated, Literal

from pydantic import Field

from api_schemas.base import UNIQUE_ITEMS, WHOLE, Schema
from api_schemas.turntable import Turntable

SIDE_MAX = 16384
"""Pixels along a side of anything: the largest texture OpenGL takes."""

Side = Annotated[int, Field(ge=1, le=SIDE_MAX), WHOLE]
Format = Literal["png", "exr"]
MediaType = Literal["image/png", "image/x-exr"]
PngBits = Literal[8, 16]
ExrType = Literal["half", "float"]
PixelFilter = Literal["box", "tent", "gaussian"]
ToneCurve = Literal["none", "reinhard", "aces"]

Layer = Literal[
    "depth",
    "position",
    "normal",
    "geometric_normal",
    "tangent",
    "uv",
    "albedo",
    "object_id",
    "material_id",
    "coverage",
    "footprint",
    "texel_density",
    "shading_difference",
    "light_visibility",
    "crypto_object",
    "crypto_material",
]

LayerName = Annotated[str, Field(pattern="^[a-z][a-z0-9_]{0,31}$")]
"""A layer of a texture; which there are, its technique says."""

MEDIA_TYPES: Mapping[Format, MediaType] = {"png": "image/png", "exr": "image/x-exr"}
"""The media type of each file format."""


def near_square(cells: int, size: list[int]) -> int:
    """Return how many cells of a size a row has, so that all rows make about a square."""
    width, height = size
    return max(1, min(cells, round(math.sqrt(cells * height / width))))


class Output(Schema):
    """Size, file format, and how light becomes numbers in it."""

    size: Annotated[list[Side], Field(min_length=2, max_length=2)] = Field(
        default=[512, 512], description="Width and height in pixels."
    )
    format: Format | None = Field(
        default=None,
        description="png for screens, exr for linear light; without one the Accept header decides, "
        "else png.",
    )
    png_bits: PngBits = Field(default=8, description="Bits per channel of a PNG.")
    exr_type: ExrType = Field(default="half", description="Precision of an EXR: 11 or 24 bits.")
    encoding: Literal["auto", "srgb", "linear"] = Field(
        default="auto",
        description="How a PNG holds light: auto is sRGB for colour and the bare numbers for data.",
    )
    exposure: Annotated[float, Field(ge=-32, le=32)] = Field(
        default=0.0,
        description="Stops by which a PNG of colour is brightened; an EXR keeps the light.",
    )
    tone_curve: ToneCurve = Field(
        default="none",
        description="How a PNG of colour keeps what is brighter than white: cut off, or rolled off "
        "softly, or like film.",
    )

    @property
    def file_size(self) -> tuple[int, int]:
        """Width and height of the file."""
        return self.size[0], self.size[1]


class TextureOutput(Output):
    """The same, for textures."""

    layers: Annotated[list[LayerName], Field(max_length=16), UNIQUE_ITEMS] = Field(
        default=[],
        json_schema_extra={"uniqueItems": True},
        description="What is told besides the picture, where the technique has something to tell: "
        "its own layers, by name. An EXR holds all that are named, as channels; a PNG shows one "
        "layer instead of the picture.",
    )
    mipmaps: bool = Field(
        default=False,
        description="Whether an EXR is cut into tiles of 64 pixels and holds the picture at half, "
        "a quarter ... of its size too, each pixel the mean of what it covers: what renderers and "
        "texture caches (.tx) read a part at a time.",
    )
    slices: Annotated[int, Field(ge=1, le=1024), WHOLE] | None = Field(
        default=None,
        description="Makes a solid texture as a volume of so many slices, the first one at w = 0; "
        "size is that of a slice.",
    )
    arrangement: Literal["atlas", "layers", "parts"] = Field(
        default="atlas",
        description="Where slices go: beside each other into one picture, in rows from the upper "
        "left, as nearly square as can be, what is left over 0; or into an EXR as layers "
        "slice_0000, slice_0001 and so on, beside the first one as the picture; or as parts of "
        "these names, each a picture of its own.",
    )

    @property
    def has_parts(self) -> bool:
        """Whether the file is one of several pictures."""
        return self.slices is not None and self.arrangement == "parts"

    @property
    def columns(self) -> int:
        """Slices in a row of the file."""
        slices = self.slices if self.slices and self.arrangement == "atlas" else 1
        return near_square(slices, self.size)

    @property
    def file_size(self) -> tuple[int, int]:
        """Width and height of the file: of all slices, where they lie beside each other."""
        slices = self.slices if self.slices and self.arrangement == "atlas" else 1
        rows = math.ceil(slices / self.columns)
        return self.size[0] * self.columns, self.size[1] * rows


class RenderOutput(Output):
    """The same, for rendered scenes."""

    supersampling: Annotated[int, Field(ge=1, le=8), WHOLE] = Field(
        default=2, description="Samples per pixel along each side: more are smoother and slower."
    )
    pixel_filter: PixelFilter = Field(
        default="box",
        description="How the samples round a pixel become its light: the mean of its own, a tent "
        "that falls to the middles of its neighbours, or a Gaussian three pixels wide. The latter "
        "two are smoother and cost samples beyond the edges of the picture.",
    )
    layers: Annotated[list[Layer], Field(max_length=16), UNIQUE_ITEMS] = Field(
        default=[],
        json_schema_extra={"uniqueItems": True},
        description="What is told of each pixel besides its colour. An EXR holds all that are "
        "named, as channels: depth Z, the distance along the view axis, 1e10 where nothing is; "
        "position P, in the world; normal N, the one that is lit, and geometric_normal Ng, that of "
        "the flat triangle, both on the eye's side; tangent T, where u grows; uv, set 0; albedo, "
        "the color of an unlit, diffuse or base, premultiplied, like light the mean of all "
        "samples; object_id, from 1 in the order of drawing, depth first; material_id, from 1 in "
        "the same order, equal surfaces together; coverage, the share of the pixel that things "
        "cover; light_visibility, the share of the lamps' light that shadows leave, 0 where a "
        "surface faces away; crypto_object and crypto_material, up to six things of a "
        "pixel with the share of each, as Cryptomatte has them, called by the nodes' names (else "
        "box 3, sphere 4) and material 1, material 2; footprint, how far uv go from this pixel to "
        "the next one, X and Y to the right, Z and W upwards: of waves, a pixel holds those of "
        "fewer than 1 / (2 footprint) cycles per tile; texel_density, how many texels of the "
        "surface's main picture fit along a pixel, 0 without one: below 1 the picture is "
        "magnified, from 2 on it is as sharp as can be; shading_difference, the light of the "
        "picture, whose samples are shaded and then averaged, less that of maps averaged over the "
        "pixel and then shaded once: what a filter cannot know of highlights and bumps, and edges. "
        "All but this one, albedo, coverage and shares belong to the nearest sample, are never "
        "averaged and 0 where nothing is; what is blended leaves them to what is behind it. A PNG "
        "shows one layer instead of the colour: albedo like a picture, directions as n / 2 + 1/2, "
        "depth as 1 / (1 + Z), uv as red and green, an id as its own code, those of Cryptomatte as "
        "a colour each, footprint as 1 + log2(x) / 16 of its lengths to the right and upwards, "
        "texel_density as x / (1 + x), shading_difference as d / 2 + 1/2, position and coverage as "
        "they are, cut off outside of 0..1.",
    )
    turntable: Turntable | None = Field(
        default=None, description="Several frames of the scene, which turns; size is that of one."
    )

    @property
    def frames(self) -> int:
        """How many times the scene is drawn."""
        return len(self.turntable.drawn) if self.turntable else 1

    @property
    def columns(self) -> int:
        """Frames in a row of the file."""
        return near_square(self.turntable.cells if self.turntable else 1, self.size)

    @property
    def file_size(self) -> tuple[int, int]:
        """Width and height of the file: of all frames, where they lie beside each other."""
        cells = self.turntable.cells if self.turntable else 1
        rows = math.ceil(cells / self.columns)
        return self.size[0] * self.columns, self.size[1] * rows
