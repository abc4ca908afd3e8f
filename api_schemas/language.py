"""The only place where the families meet.

Each folder of specs becomes a union named here; a texture may hold textures, so the specs speak of
these names before the folders are read, and are completed at the end of this module.
"""

import importlib
import pkgutil
from functools import reduce
from operator import or_
from types import ModuleType
from typing import TYPE_CHECKING, Annotated, Any, TypeAlias, get_args

from pydantic import Discriminator, GetCoreSchemaHandler, Tag
from pydantic_core import core_schema
from typing_extensions import TypeAliasType

from api_schemas import coordinates, layouts, surfaces, textures
from api_schemas.base import Color, NonNegative, Number, Schema
from api_schemas.dishes import CellsSpec, DishSpec, ReactionSpec
from api_schemas.families import (
    CoordinatesSpec,
    LayoutSpec,
    SurfaceSpec,
    TechniqueSpec,
    TextureSpec,
)
from api_schemas.maps import (
    ColorMap,
    DensityMap,
    LightMap,
    Map,
    NormalMap,
    NumberMap,
    ScaledMap,
)
from api_schemas.parameters import ParameterMap
from api_schemas.relief import (
    BumpMap,
    Displacement,
    HeightMap,
    ParallaxMap,
    ReliefMap,
    TangentFrames,
)


def specs_in(folder: ModuleType, family: type[TechniqueSpec]) -> dict[str, type[TechniqueSpec]]:
    """Return a folder's specs by technique, in alphabetical order.

    Raises:
        TypeError: A module does not define exactly one spec whose technique is the module's name.
    """
    found = {}
    for name in sorted(info.name for info in pkgutil.iter_modules(folder.__path__)):
        module = importlib.import_module(f"{folder.__name__}.{name}")
        specs = [
            value
            for value in vars(module).values()
            if isinstance(value, type)
            and issubclass(value, family)
            and value.__module__ == module.__name__
        ]
        if len(specs) != 1 or get_args(specs[0].model_fields["technique"].annotation) != (name,):
            raise TypeError(
                f"{module.__name__} must define one {family.__name__} "
                f"with technique: Literal[{name!r}]"
            )
        found[name] = specs[0]
    return found


FAMILIES: dict[str, dict[str, type[TechniqueSpec]]] = {
    "textures": specs_in(textures, TextureSpec),
    "coordinates": specs_in(coordinates, CoordinatesSpec),
    "layouts": specs_in(layouts, LayoutSpec),
    "surfaces": specs_in(surfaces, SurfaceSpec),
}
"""Every technique there is, by family and name."""


def _json_type(value: object) -> str:
    """Choose by JSON type, so that one mistake gives one problem at one place."""
    return "map" if isinstance(value, dict | Schema) else "value"


def _mappable(value: Any, mapped: Any) -> Any:
    return Annotated[
        Annotated[value, Tag("value")] | Annotated[mapped, Tag("map")], Discriminator(_json_type)
    ]


class _ByTechnique:
    """Chooses a member of a family by its technique.

    The same as a discriminator in a Field, which pydantic loses where a spec that is still being
    built holds its own family: there it would try every member and tell the mistakes of all.
    """

    def __init__(self, members: dict[str, type[TechniqueSpec]]) -> None:
        self._members = members

    def __get_pydantic_core_schema__(
        self, _source: object, handler: GetCoreSchemaHandler
    ) -> core_schema.CoreSchema:
        choices = {name: handler.generate_schema(spec) for name, spec in self._members.items()}
        return core_schema.tagged_union_schema(choices, discriminator="technique")


if TYPE_CHECKING:
    Texture: TypeAlias = TextureSpec
    Coordinates: TypeAlias = CoordinatesSpec
    Layout: TypeAlias = LayoutSpec
    Surface: TypeAlias = SurfaceSpec
    Operand: TypeAlias = float | TextureSpec
    MappableNumber: TypeAlias = float | NumberMap
    MappableNonNegative: TypeAlias = float | NumberMap
    MappableDensity: TypeAlias = float | DensityMap
    MappableColor: TypeAlias = list[float] | ColorMap
else:

    def _one_of(name, family):
        members = FAMILIES[family]
        return TypeAliasType(name, Annotated[reduce(or_, members.values()), _ByTechnique(members)])

    Texture = _one_of("Texture", "textures")
    Coordinates = _one_of("Coordinates", "coordinates")
    Layout = _one_of("Layout", "layouts")
    Surface = _one_of("Surface", "surfaces")
    Operand = TypeAliasType("Operand", _mappable(Number, Texture))
    MappableNumber = TypeAliasType("MappableNumber", _mappable(Number, NumberMap))
    MappableNonNegative = TypeAliasType("MappableNonNegative", _mappable(NonNegative, NumberMap))
    MappableDensity = TypeAliasType("MappableDensity", _mappable(NonNegative, DensityMap))
    MappableColor = TypeAliasType("MappableColor", _mappable(Color, ColorMap))


def _complete() -> None:
    names = {
        name: globals()[name]
        for name in (
            "Texture",
            "Coordinates",
            "Layout",
            "Surface",
            "Operand",
            "MappableNumber",
            "MappableNonNegative",
            "MappableDensity",
            "MappableColor",
        )
    } | {model.__name__: model for model in (LightMap, NormalMap, BumpMap, HeightMap, ParallaxMap)}
    names["TangentFrames"] = TangentFrames
    members = [spec for family in FAMILIES.values() for spec in family.values()]
    models: list[type[Schema]] = [Map, ScaledMap, ColorMap, LightMap, NumberMap, DensityMap]
    models += [NormalMap, ReliefMap, BumpMap, HeightMap, ParallaxMap, Displacement, SurfaceSpec]
    models += [ParameterMap, *ParameterMap.__subclasses__(), CellsSpec, DishSpec, ReactionSpec]
    for model in (*models, *members):
        module = importlib.import_module(model.__module__)
        model.model_rebuild(force=True, _types_namespace={**vars(module), **names})


_complete()
