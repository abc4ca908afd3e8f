"""Numbers read from pictures of four bytes."""

from __future__ import annotations

from typing import Annotated, ClassVar, Literal

from pydantic import Field

from api_schemas.cost import Cost
from api_schemas.families import Meaning, TextureSpec
from api_schemas.maps import DATA
from api_schemas.members import Texture


class UnpackFloatSpec(TextureSpec):
    """Reads the numbers that `pack_float` wrote, bit by bit.

    An upload must be asked for at its own size: blended bytes mean nothing. What is not finite
    reads as 0, or as the largest number there is.
    """

    source: ClassVar[str] = (
        "Hughes et al., 2013, section 20.10 (textures as memory); IEEE 754, 1985 (binary32)"
    )
    equation: ClassVar[str] = "the number's bits = red 2^24 + green 2^16 + blue 2^8 + alpha"
    meaning: ClassVar[Meaning] = "data"

    technique: Literal["unpack_float"]
    input: Annotated[Texture, DATA] = Field(description="The picture of four bytes.")

    def cost(self, pixels: int) -> Cost:
        """Bytes are put into other places."""
        return Cost(seconds=pixels * 6e-8, bytes=pixels * 48.0)
