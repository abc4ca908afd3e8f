"""What the finished picture looks like as a file."""

from collections.abc import Mapping
from typing import Annotated, Literal

from pydantic import Field

from api_schemas.base import WHOLE, Schema

SIDE_MAX = 16384
"""Pixels along a side of anything: the largest texture OpenGL takes."""

Side = Annotated[int, Field(ge=1, le=SIDE_MAX), WHOLE]
Format = Literal["png", "exr"]
MediaType = Literal["image/png", "image/x-exr"]
PngBits = Literal[8, 16]
ExrType = Literal["half", "float"]
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
]

MEDIA_TYPES: Mapping[Format, MediaType] = {"png": "image/png", "exr": "image/x-exr"}
"""The media type of each file format."""


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


class RenderOutput(Output):
    """The same, for rendered scenes."""

    supersampling: Annotated[int, Field(ge=1, le=8), WHOLE] = Field(
        default=2, description="Samples per pixel along each side: more are smoother and slower."
    )
    layers: Annotated[list[Layer], Field(max_length=10)] = Field(
        default=[],
        json_schema_extra={"uniqueItems": True},
        description="What an EXR tells of each pixel besides its colour; a PNG shows one layer "
        "instead of the colour.",
    )
