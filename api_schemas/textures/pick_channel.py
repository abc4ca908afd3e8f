"""One channel of a texture."""

from __future__ import annotations

from typing import ClassVar, Literal

from pydantic import Field

from api_schemas.cost import Cost
from api_schemas.families import Meaning, TextureSpec
from api_schemas.members import Texture


class PickChannelSpec(TextureSpec):
    """Takes one channel out of a texture, or how bright it is to the eye, as plain numbers."""

    source: ClassVar[str] = "ITU-R BT.709 (luminance)"
    equation: ClassVar[str] = "luminance = .2126 r + .7152 g + .0722 b"
    meaning: ClassVar[Meaning] = "data"
    solid: ClassVar[bool] = True
    pointwise: ClassVar[bool] = True

    technique: Literal["pick_channel"]
    input: Texture = Field(description="The texture it is taken from, read as its own place is.")
    channel: Literal["r", "g", "b", "a", "luminance"] = Field(
        default="luminance",
        description="Which one: a grey counts as red, green and blue alike, what has no alpha is "
        "opaque, and what data has no channel for is 0.",
    )

    def cost(self, pixels: int) -> Cost:
        """One picture is read once."""
        return Cost(seconds=pixels * 4e-8, bytes=pixels * 48.0)
