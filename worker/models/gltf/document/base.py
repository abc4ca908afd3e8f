"""What the objects of a glTF document share."""

from typing import Annotated, Any, ClassVar, TypeVar

from pydantic import AfterValidator, BaseModel, ConfigDict, Field, model_validator
from pydantic.alias_generators import to_camel

from api_schemas.base import FLOAT32_MAX, WHOLE

Item = TypeVar("Item")


class GltfObject(BaseModel):
    """A frozen JSON object with typed members; glTF knows no null."""

    model_config = ConfigDict(
        frozen=True,
        extra="ignore",
        strict=True,
        allow_inf_nan=False,
        alias_generator=to_camel,
    )
    _keys: ClassVar[frozenset[str]] = frozenset()

    @classmethod
    def __pydantic_init_subclass__(cls, **_: Any) -> None:
        """Note the JSON names of the members."""
        cls._keys = frozenset(field.alias or name for name, field in cls.model_fields.items())

    @model_validator(mode="before")
    @classmethod
    def _without_nulls(cls, value: Any) -> Any:
        if isinstance(value, dict) and None in value.values():
            for key in cls._keys:
                if value.get(key, 0) is None:
                    raise ValueError(f"{key} is null")
        return value


def _unlike(items: list[Item]) -> list[Item]:
    if len(set(items)) != len(items):
        raise ValueError("two elements are equal")
    return items


Index = Annotated[int, Field(ge=0, le=2**32 - 1), WHOLE]
Count = Annotated[int, Field(ge=1, le=2**53), WHOLE]
Offset = Annotated[int, Field(ge=0, le=2**53), WHOLE]
Code = Annotated[int, Field(ge=-(2**53), le=2**53), WHOLE]
"""A number from a list of choices; one that is not on the list is told where it is used."""

Real = Annotated[float, Field(ge=-FLOAT32_MAX, le=FLOAT32_MAX)]
NonNegativeReal = Annotated[float, Field(ge=0, le=FLOAT32_MAX)]
Fraction = Annotated[float, Field(ge=0, le=1)]
Reals2 = Annotated[list[Real], Field(min_length=2, max_length=2)]
Reals3 = Annotated[list[Real], Field(min_length=3, max_length=3)]
Reals16 = Annotated[list[Real], Field(min_length=16, max_length=16)]
Fractions3 = Annotated[list[Fraction], Field(min_length=3, max_length=3)]
Fractions4 = Annotated[list[Fraction], Field(min_length=4, max_length=4)]

Indices = Annotated[list[Index], Field(min_length=1), AfterValidator(_unlike)]
Words = Annotated[list[str], Field(min_length=1), AfterValidator(_unlike)]


NAME_LENGTH_MAX = 256


class Named(GltfObject):
    """An object with a name for people, empty if it has none; more than 256 letters are cut."""

    name: Annotated[str, AfterValidator(lambda name: name[:NAME_LENGTH_MAX])] = ""
