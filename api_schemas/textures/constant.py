"""One value everywhere."""

from typing import Annotated, ClassVar, Literal

from pydantic import Discriminator, Field, Tag

from api_schemas.base import Number
from api_schemas.families import TextureSpec

Channels = Annotated[list[Number], Field(min_length=1, max_length=4)]


def _json_type(value: object) -> str:
    return "channels" if isinstance(value, list) else "number"


class ConstantSpec(TextureSpec):
    """The same value at every point."""

    source: ClassVar[str] = "none needed"
    equation: ClassVar[str] = "f(u, v) = value"

    surface_side: ClassVar[int] = 1
    solid: ClassVar[bool] = True
    pointwise: ClassVar[bool] = True

    technique: Literal["constant"]
    value: Annotated[
        Annotated[Number, Tag("number")] | Annotated[Channels, Tag("channels")],
        Discriminator(_json_type),
    ] = Field(
        description="A grey, or 1 to 4 linear channels; with 2 or 4 the last is straight alpha."
    )

    def has_formula(self) -> bool:
        """Always."""
        return True
