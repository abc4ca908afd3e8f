"""Texture techniques: the module named after a technique makes its picture.

Every technique module has

    def synthesize(spec, size: tuple[int, int], inputs: Mapping[str, Image]) -> Image

with size = (width, height) and `inputs` the pictures that the spec's fields hold, by field name,
made at the same size. It is a pure function: no clock, no state, inputs are never modified.
One whose spec is `solid` but not `pointwise` also has

    def synthesize_volume(spec, size: tuple[int, int, int], inputs: Mapping[str, Volume],
                          report: Report) -> Volume

with size = (width, height, depth) and the volumes of its fields.
A module with kernels also has `warm()`, which compiles them. A leading underscore marks pieces
that techniques share.
"""

from __future__ import annotations

import importlib
import pkgutil
from collections import Counter
from typing import TYPE_CHECKING, cast

from api_schemas.families import Meaning, TextureSpec
from api_schemas.textures.image import ImageSpec
from api_schemas.walk import meaning_of
from worker.images.volume import Volume

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Mapping
    from types import ModuleType

    from worker.images.image import Image
    from worker.stages import Report

    Key = tuple[str, Meaning]
    Load = Callable[[ImageSpec, Meaning], Image]


def synthesize(
    spec: TextureSpec, size: tuple[int, int], load: Load, meaning: Meaning = "colour"
) -> Image:
    """Make the picture of a texture and of all textures nested in it, at (width, height).

    Equal nested textures are made once.

    Args:
        spec: A texture of any technique.
        size: Width and height in pixels, also of every nested picture.
        load: Gives the picture of an uploaded asset in linear light, at its own size, for a slot
            that is read as colour or as data.
        meaning: Of the slot that the texture itself is in.

    Raises:
        WorkerError: Whatever `load` raises.
    """
    uses = Counter(_keys(spec, meaning))
    shared: dict[Key, Image] = {}

    def make(spec: TextureSpec, meaning: Meaning) -> Image:
        key = _key(spec, meaning)
        if key in shared:
            return shared[key]
        inputs = {name: make(*slot) for name, slot in _slots(spec, meaning).items()}
        if isinstance(spec, ImageSpec):
            inputs["asset"] = load(spec, meaning)
        image = cast("Image", _module(spec.technique).synthesize(spec, size, inputs))
        if uses[key] > 1:
            shared[key] = image
        return image

    return make(spec, meaning)


def synthesize_volume(
    spec: TextureSpec, size: tuple[int, int, int], report: Report, meaning: Meaning = "colour"
) -> Volume:
    """Make the volume of a solid texture and of all textures nested in it.

    Equal nested textures are made once.

    Args:
        spec: A texture of a solid technique, with none but solid ones in it.
        size: Width, height and depth in voxels, also of every nested volume.
        report: Told the share that is done, 0..1, and the technique that is at work.
        meaning: Of the slot that the texture itself is in.
    """
    uses = Counter(_keys(spec, meaning))
    shared: dict[Key, Volume] = {}
    made = 0

    def make(spec: TextureSpec, meaning: Meaning) -> Volume:
        nonlocal made
        key = _key(spec, meaning)
        if key in shared:
            return shared[key]
        inputs = {name: make(*slot) for name, slot in _slots(spec, meaning).items()}
        report(made / len(uses), spec.technique)
        volume = _fill(
            spec,
            size,
            inputs,
            lambda share, step: report((made + share) / len(uses), f"{spec.technique}: {step}"),
        )
        made += 1
        if uses[key] > 1:
            shared[key] = volume
        return volume

    return make(spec, meaning)


def techniques() -> list[str]:
    """Return the names of the techniques in this folder, in alphabetical order."""
    names = (module.name for module in pkgutil.iter_modules(__path__))
    return sorted(name for name in names if not name.startswith("_"))


def warm(report: Report) -> None:
    """Compile every kernel, or load it from the cache; `report` gets share done and name."""
    names = techniques()
    for done, name in enumerate(names):
        report(done / len(names), name)
        module = _module(name)
        if hasattr(module, "warm"):
            module.warm()


def _fill(
    spec: TextureSpec, size: tuple[int, int, int], inputs: Mapping[str, Volume], report: Report
) -> Volume:
    """Make one volume; what is pointwise sees all slices below each other as one picture."""
    module = _module(spec.technique)
    if not spec.pointwise:
        return cast("Volume", module.synthesize_volume(spec, size, inputs, report))
    width, height, depth = size
    stacked = {name: volume.stacked() for name, volume in inputs.items()}
    return Volume.unstacked(module.synthesize(spec, (width, height * depth), stacked), depth)


def _slots(spec: TextureSpec, meaning: Meaning) -> dict[str, tuple[TextureSpec, Meaning]]:
    """Return the textures directly within a spec, each with the meaning of its slot."""
    slots = {}
    for name, field in type(spec).model_fields.items():
        value = getattr(spec, name)
        if isinstance(value, TextureSpec):
            slots[name] = (value, meaning_of(field, meaning))
    return slots


def _key(spec: TextureSpec, meaning: Meaning) -> Key:
    return (spec.model_dump_json(), meaning)


def _keys(spec: TextureSpec, meaning: Meaning) -> Iterator[Key]:
    yield _key(spec, meaning)
    for slot in _slots(spec, meaning).values():
        yield from _keys(*slot)


def _module(technique: str) -> ModuleType:
    return importlib.import_module(f"{__name__}.{technique}")
