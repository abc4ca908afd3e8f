"""Numbers kept in pictures of four bytes."""

from __future__ import annotations

from typing import Annotated, ClassVar, Literal

from pydantic import Field

from api_schemas.cost import Cost
from api_schemas.families import Meaning, TextureSpec
from api_schemas.maps import DATA
from api_schemas.members import Texture


class PackFloatSpec(TextureSpec):
    """Writes each number of 32 bits as the four bytes of a pixel: a PNG then holds it bit by bit.

    Maps of numbers read such pictures as channel `packed`, other textures by `unpack_float`.
    """

    source: ClassVar[str] = (
        "Hughes et al., 2013, section 20.10 (textures as memory); IEEE 754, 1985 (binary32)"
    )
    equation: ClassVar[str] = "red 2^24 + green 2^16 + blue 2^8 + alpha = the number's bits"
    meaning: ClassVar[Meaning] = "data"

    technique: Literal["pack_float"]
    input: Annotated[Texture, DATA] = Field(description="The numbers.")
    channel: Literal["r", "g", "b", "a"] = Field(
        default="r", description="Which channel of the input is kept."
    )

    def cost(self, pixels: int) -> Cost:
        """Bytes are put into other places."""
        return Cost(seconds=pixels * 6e-8, bytes=pixels * 48.0)
