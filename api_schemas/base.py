"""What contracts share: immutable, closed to unknown fields, numbers that float32 can hold."""

from typing import Annotated, Any

from pydantic import AfterValidator, BaseModel, BeforeValidator, ConfigDict, Field
from pydantic_core import PydanticCustomError

FLOAT32_MAX = 3.4028234663852886e38
LENGTH_MAX = 1e6
LENGTH_MIN = 1e-6


class Schema(BaseModel):
    """A frozen value that refuses unknown fields, NaN, infinities and numbers dressed as text."""

    model_config = ConfigDict(
        frozen=True,
        extra="forbid",
        strict=True,
        allow_inf_nan=False,
        defer_build=True,
    )


def _whole(value: Any) -> Any:
    """JSON has one kind of number: 512.0 is the integer 512."""
    return int(value) if isinstance(value, float) and value.is_integer() else value


def _different(items: list[Any]) -> list[Any]:
    if len(set(items)) < len(items):
        raise PydanticCustomError("repeated", "an item is there twice")
    return items


Real = Annotated[float, Field(strict=True, allow_inf_nan=False)]
"""Says itself what Schema says: an alias in a union is not told the settings of who names it."""
Number = Annotated[Real, Field(ge=-FLOAT32_MAX, le=FLOAT32_MAX)]
NonNegative = Annotated[Real, Field(ge=0, le=FLOAT32_MAX)]
Length = Annotated[Real, Field(ge=LENGTH_MIN, le=LENGTH_MAX)]
Coordinate = Annotated[Real, Field(ge=-LENGTH_MAX, le=LENGTH_MAX)]
Angle = Annotated[Real, Field(ge=-1000, le=1000)]
WHOLE = BeforeValidator(_whole)
"""Goes last in the annotation of an integer field, after its bounds."""
UNIQUE_ITEMS = AfterValidator(_different)
"""Goes last in the annotation of a list that says `uniqueItems` in its schema."""
Seed = Annotated[int, Field(strict=True, ge=0, le=2**32 - 1), WHOLE]

Pair = Annotated[list[Coordinate], Field(min_length=2, max_length=2)]
Vector = Annotated[list[Coordinate], Field(min_length=3, max_length=3)]
Color = Annotated[list[NonNegative], Field(min_length=3, max_length=3)]
Matrix4 = Annotated[list[Coordinate], Field(min_length=16, max_length=16)]
SHA256_PATTERN = "^[0-9a-f]{64}$"
Sha256 = Annotated[str, Field(pattern=SHA256_PATTERN, min_length=64, max_length=64)]
Link = Annotated[str, Field(max_length=256)]
