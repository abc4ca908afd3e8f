"""What is known of an uploaded file: measured once, then trusted by costs and by validation."""

from typing import Annotated, Literal

from pydantic import Field

from api_schemas.base import WHOLE, Schema, Sha256

Positive = Annotated[int, Field(ge=1, le=2**53), WHOLE]


class AssetFacts(Schema):
    """An uploaded picture, named by the hash of its bytes."""

    sha256: Sha256 = Field(description="SHA-256 of the file's bytes: the asset's name.")
    kind: Literal["image"] = Field(description="What the file holds.")
    media_type: Annotated[str, Field(max_length=64)] = Field(
        description="Media type by the file's content, whatever the upload called it."
    )
    format: Annotated[str, Field(max_length=16)] = Field(
        description="File format by content: png, openexr, jpeg and so on."
    )
    bytes: Positive = Field(description="Length of the file.")
    width: Positive = Field(description="Pixels from left to right.")
    height: Positive = Field(description="Pixels from top to bottom.")
    channels: Annotated[int, Field(ge=1, le=4), WHOLE] = Field(
        description="How many numbers a pixel has."
    )
    bits: Literal[8, 16, 32] = Field(description="Bits of each of these numbers.")
    float: bool = Field(description="Whether they are floating point numbers.")
    has_alpha: bool = Field(description="Whether the last channel is coverage.")
