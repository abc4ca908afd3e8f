"""Parameters of a texture that may be textures themselves: a number, or one for each point."""

from typing import Annotated, Any

from pydantic import Discriminator, Field, Tag

from api_schemas.base import Schema
from api_schemas.maps import DATA
from api_schemas.members import Texture

_PAIR = Field(
    min_length=2,
    max_length=2,
    description="The numbers that 0 and 1 of the texture stand for; beyond, they are kept.",
)

Feed = Annotated[float, Field(ge=0, le=0.1)]
Quarter = Annotated[float, Field(ge=0, le=0.25)]
Fifth = Annotated[float, Field(ge=0, le=0.2)]
Rate = Annotated[float, Field(ge=0, le=100)]
Signed = Annotated[float, Field(ge=-100, le=100)]


class ParameterMap(Schema):
    """A texture in the place of a number: its first channel leads through a range."""

    texture: Annotated["Texture", DATA] = Field(
        description="Says for each point where in the range its number lies."
    )
    range: Annotated[list[float], _PAIR]


class FeedMap(ParameterMap):
    """A rate of at most a tenth by a texture."""

    range: Annotated[list[Feed], _PAIR]


class QuarterMap(ParameterMap):
    """A number of at most a quarter by a texture."""

    range: Annotated[list[Quarter], _PAIR]


class FifthMap(ParameterMap):
    """A number of at most a fifth by a texture."""

    range: Annotated[list[Fifth], _PAIR]


class RateMap(ParameterMap):
    """A rate by a texture."""

    range: Annotated[list[Rate], _PAIR]


class SignedMap(ParameterMap):
    """A number of either sign by a texture."""

    range: Annotated[list[Signed], _PAIR]


def _json_type(value: Any) -> str:
    return "map" if isinstance(value, dict | ParameterMap) else "number"


_BY_TYPE = Discriminator(_json_type)

MappedFeed = Annotated[Annotated[Feed, Tag("number")] | Annotated[FeedMap, Tag("map")], _BY_TYPE]
MappedQuarter = Annotated[
    Annotated[Quarter, Tag("number")] | Annotated[QuarterMap, Tag("map")], _BY_TYPE
]
MappedFifth = Annotated[Annotated[Fifth, Tag("number")] | Annotated[FifthMap, Tag("map")], _BY_TYPE]
MappedRate = Annotated[Annotated[Rate, Tag("number")] | Annotated[RateMap, Tag("map")], _BY_TYPE]
MappedSigned = Annotated[
    Annotated[Signed, Tag("number")] | Annotated[SignedMap, Tag("map")], _BY_TYPE
]


def ends(parameter: float | ParameterMap) -> tuple[float, float]:
    """Return the least and the greatest number that a parameter has anywhere."""
    if isinstance(parameter, ParameterMap):
        return min(parameter.range), max(parameter.range)
    return parameter, parameter
