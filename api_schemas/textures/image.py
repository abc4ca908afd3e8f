"""An uploaded picture."""

from typing import ClassVar, Literal

from pydantic import Field

from api_schemas.base import Sha256
from api_schemas.families import TextureSpec


class ImageSpec(TextureSpec):
    """A picture that was uploaded as an asset."""

    source: ClassVar[str] = "Catmull, 1974; Blinn and Newell, 1976"
    equation: ClassVar[str] = "texel centres at ((column + 1/2) / width, 1 - (row + 1/2) / height)"

    technique: Literal["image"]
    asset: Sha256 = Field(description="The picture's SHA-256, as its upload answered.")
    encoding: Literal["auto", "srgb", "linear"] = Field(
        default="auto",
        description="How numbers in the file mean light: auto takes 8 and 16 bit pictures in the "
        "place of a colour as sRGB, everything else as linear.",
    )
    alpha: Literal["use", "ignore"] = Field(
        default="use",
        description="Whether colour fades with the picture's alpha or is taken as if it had none.",
    )
    edge_texels: Literal["whole", "halved"] = Field(
        default="whole",
        description="Whether the picture's edges run round its outermost texels, or through their "
        "middles, as OpenEXR and Mitsuba have it of a sky in longitude and latitude: its first and "
        "last columns are then the same, and its first and last rows the poles.",
    )
