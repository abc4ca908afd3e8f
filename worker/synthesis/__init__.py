"""Texture techniques: the module named after a technique makes its picture.

Every technique module has

    def synthesize(spec, size: tuple[int, int], inputs: Mapping[str, Image]) -> Image

with size = (width, height) and `inputs` the pictures that the spec's fields hold, by field name,
made at the same size. It is a pure function: no clock, no state, inputs are never modified.
A module with kernels also has `warm()`, which compiles them. A leading underscore marks pieces
that techniques share.
"""

from __future__ import annotations

import importlib
import pkgutil
from collections import Counter
from typing import TYPE_CHECKING, cast

from api_schemas.families import TextureSpec
from api_schemas.textures.image import ImageSpec
from api_schemas.walk import parts

if TYPE_CHECKING:
    from collections.abc import Callable
    from types import ModuleType

    from worker.images.image import Image

    Load = Callable[[ImageSpec], Image]


def synthesize(spec: TextureSpec, size: tuple[int, int], load: Load) -> Image:
    """Make the picture of a texture and of all textures nested in it, at (width, height).

    Equal nested textures are made once.

    Args:
        spec: A texture of any technique.
        size: Width and height in pixels, also of every nested picture.
        load: Gives the picture of an uploaded asset in linear light, at its own size.

    Raises:
        WorkerError: Whatever `load` raises.
    """
    uses = Counter(_key(part) for _, part in parts(spec) if isinstance(part, TextureSpec))
    shared: dict[str, Image] = {}

    def make(spec: TextureSpec) -> Image:
        key = _key(spec)
        if key in shared:
            return shared[key]
        fields = {name: getattr(spec, name) for name in type(spec).model_fields}
        inputs = {
            name: make(value) for name, value in fields.items() if isinstance(value, TextureSpec)
        }
        if isinstance(spec, ImageSpec):
            inputs["asset"] = load(spec)
        image = cast("Image", _module(spec.technique).synthesize(spec, size, inputs))
        if uses[key] > 1:
            shared[key] = image
        return image

    return make(spec)


def techniques() -> list[str]:
    """Return the names of the techniques in this folder, in alphabetical order."""
    names = (module.name for module in pkgutil.iter_modules(__path__))
    return sorted(name for name in names if not name.startswith("_"))


def warm(report: Callable[[float, str], None]) -> None:
    """Compile every kernel, or load it from the cache; `report` gets share done and name."""
    names = techniques()
    for done, name in enumerate(names):
        report(done / len(names), name)
        module = _module(name)
        if hasattr(module, "warm"):
            module.warm()


def _key(spec: TextureSpec) -> str:
    return spec.model_dump_json()


def _module(technique: str) -> ModuleType:
    return importlib.import_module(f"{__name__}.{technique}")
