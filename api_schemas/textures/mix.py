"""One texture over another."""

from __future__ import annotations

from typing import Annotated, Any, ClassVar, Literal

from pydantic import Discriminator, Field, Tag

from api_schemas.cost import Cost
from api_schemas.families import TextureSpec
from api_schemas.maps import DATA
from api_schemas.members import Texture

Share = Annotated[float, Field(ge=0, le=1)]


def _json_type(value: Any) -> str:
    return "texture" if isinstance(value, dict | TextureSpec) else "number"


class MixSpec(TextureSpec):
    """Blends two textures, everywhere alike or by a third one as a mask."""

    source: ClassVar[str] = "Porter and Duff, 1984; Cook, 1984"
    equation: ClassVar[str] = "(1 - amount) a + amount b"
    solid: ClassVar[bool] = True
    pointwise: ClassVar[bool] = True

    technique: Literal["mix"]
    a: Texture = Field(description="What is seen where the amount is 0.")
    b: Texture = Field(description="What is seen where the amount is 1.")
    amount: Annotated[
        Annotated[Share, Tag("number")] | Annotated[Texture, Tag("texture")],
        Discriminator(_json_type),
        DATA,
    ] = Field(
        default=0.5,
        description="How much of b is seen: a number, or a texture whose first channel, held "
        "within 0..1, says it for each point.",
    )

    def has_formula(self) -> bool:
        """Always."""
        return True

    def cost(self, pixels: int) -> Cost:
        """Both pictures are read once."""
        return Cost(seconds=pixels * 1e-7, bytes=pixels * 64.0)
