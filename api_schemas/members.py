"""What a spec writes where it takes any member of a family.

The members need not be there yet: their folders are read when pydantic first asks what a spec looks
like, so that textures may hold textures.
"""

from typing import TYPE_CHECKING, Annotated, Any, TypeAlias

from pydantic import Discriminator, GetCoreSchemaHandler, Tag
from pydantic_core import core_schema
from typing_extensions import TypeAliasType

from api_schemas.base import Number, Schema

if TYPE_CHECKING:
    from api_schemas.families import CoordinatesSpec, LayoutSpec, TextureSpec


def _json_type(value: object) -> str:
    """Choose by JSON type, so that one mistake gives one problem at one place."""
    return "map" if isinstance(value, dict | Schema) else "value"


def mappable(value: Any, mapped: Any) -> Any:
    """Return the type of a plain value or of what stands for it: a map, or a texture."""
    return Annotated[
        Annotated[value, Tag("value")] | Annotated[mapped, Tag("map")], Discriminator(_json_type)
    ]


class OneOf:
    """Chooses a member of a family by its technique.

    The same as a discriminator in a Field, which pydantic loses where a spec that is still being
    built holds its own family: there it would try every member and tell the mistakes of all.
    """

    def __init__(self, family: str) -> None:
        self._family = family

    def __get_pydantic_core_schema__(
        self, _source: object, handler: GetCoreSchemaHandler
    ) -> core_schema.CoreSchema:
        from api_schemas.language import FAMILIES  # noqa: PLC0415

        members = FAMILIES[self._family].items()
        choices = {name: handler.generate_schema(spec) for name, spec in members}
        return core_schema.tagged_union_schema(choices, discriminator="technique")


if TYPE_CHECKING:
    Texture: TypeAlias = TextureSpec
    Coordinates: TypeAlias = CoordinatesSpec
    Layout: TypeAlias = LayoutSpec
    Operand: TypeAlias = float | TextureSpec
else:
    Texture = TypeAliasType("Texture", Annotated[Any, OneOf("textures")])
    Coordinates = TypeAliasType("Coordinates", Annotated[Any, OneOf("coordinates")])
    Layout = TypeAliasType("Layout", Annotated[Any, OneOf("layouts")])
    Operand = TypeAliasType("Operand", mappable(Number, Texture))
