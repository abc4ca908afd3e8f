"""The only place where the families meet: each folder of specs is read into one of them."""

import importlib
import pkgutil
from types import ModuleType
from typing import get_args

from api_schemas import coordinates, layouts, surfaces, textures
from api_schemas.families import CoordinatesSpec, LayoutSpec, TechniqueSpec, TextureSpec
from api_schemas.surface_spec import SurfaceSpec


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
