"""Texture techniques: the module named after a technique makes its picture.

Every technique module has

    def synthesize(
        spec, size: tuple[int, int], inputs: Mapping[str, Image], report: Progress
    ) -> Image | Outcome

with size = (width, height), `inputs` the pictures that the spec's fields hold, by field name,
made at the same size unless the spec's `inner_size` or a slot (`MadeAt`) says otherwise, and
`report` to be told the share that is done and the step, where there are steps, and what there is to
see of it. It is a pure function: no clock, no state, inputs are never modified. An Outcome is a
picture with layers beside it, or with something to say of it.
One whose spec is `solid` but not `pointwise` also has

    def synthesize_volume(
        spec, size: tuple[int, int, int], inputs: Mapping[str, Volume], report: Report
    ) -> Volume

with size = (width, height, depth) and the volumes of its fields. One that is a formula has

    def closed_form(spec, *, solid: bool) -> Mapping[str, Parameter] | None

which gives the arguments of its GLSL chunk (`worker.closed_form`), or None for a spec of which
there is no formula. What its fields hold is left out; the chunk takes it as `<field>_value`.
A module with kernels also has `warm()`, which compiles them. A leading underscore marks pieces
that techniques share.
"""

from __future__ import annotations

import functools
import importlib
import pkgutil
from collections import Counter
from typing import TYPE_CHECKING, cast

from api_schemas.families import Meaning, PresetSpec, TextureSpec
from api_schemas.language import FAMILIES
from api_schemas.maps import DATA
from api_schemas.own_size import Size, size_within
from api_schemas.parameters import ParameterMap
from api_schemas.textures.image import ImageSpec
from api_schemas.walk import fields_within, is_in_space, meaning_of
from worker.closed_form import ClosedForm
from worker.images.volume import Volume
from worker.numba_kernel import compiled_once
from worker.outcome import Outcome
from worker.stages import silent

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Mapping
    from types import ModuleType

    from worker.images.image import Image
    from worker.stages import Report

    Key = tuple[str, Meaning]
    SizedKey = tuple[str, Meaning, Size]
    Load = Callable[[ImageSpec, Meaning], Image]


def synthesize(
    spec: TextureSpec,
    size: tuple[int, int],
    load: Load,
    meaning: Meaning = "colour",
    report: Report = silent,
) -> Image:
    """Make the picture of a texture and of all textures nested in it, at (width, height).

    The same as `outcome`, of which it is the image.
    """
    return outcome(spec, size, load, meaning, report).image


def outcome(
    spec: TextureSpec,
    size: tuple[int, int],
    load: Load,
    meaning: Meaning = "colour",
    report: Report = silent,
    show: Callable[[Image], None] | None = None,
) -> Outcome:
    """Make the picture of a texture, with its layers and what there is to say of it.

    Equal nested textures are made once.

    Args:
        spec: A texture of any technique.
        size: Width and height in pixels, also of what is nested in it but for techniques that
            count in cells or copy pixels.
        load: Gives the picture of an uploaded asset in linear light, at its own size, for a slot
            that is read as colour or as data.
        meaning: Of the slot that the texture itself is in.
        report: Told the finished part, 0..1, and the technique or its step.
        show: Given what there is to see of the texture itself while it is made.

    Raises:
        WorkerError: Whatever `load` or a technique raises.
    """

    @functools.cache
    def loaded(picture: ImageSpec, meaning: Meaning) -> Image:
        return load(picture, meaning)

    uses = Counter(_sized_keys(spec, meaning, size, loaded))
    shared: dict[SizedKey, Outcome] = {}
    done = 0
    top = spec

    def make(spec: TextureSpec, meaning: Meaning, size: Size) -> Outcome:
        nonlocal done
        key = (*_key(spec, meaning), size)
        if key in shared:
            return shared[key]
        sizes = _sizes(spec, meaning, size, loaded)
        slots = _slots(spec, meaning)
        inputs = {name: make(*slot, sizes[name]).image for name, slot in slots.items()}
        if isinstance(spec, ImageSpec):
            inputs["asset"] = loaded(spec, meaning)
        before = done

        def told(share: float, step: str, preview: Image | None = None) -> None:
            report((before + share) / len(uses), step)
            if show is not None and preview is not None and spec is top:
                show(preview)

        told(0.0, spec.technique)
        made = _module(spec.technique).synthesize(spec, size, inputs, told)
        done += 1
        finished = made if isinstance(made, Outcome) else Outcome(made)
        if uses[key] > 1:
            shared[key] = finished
        return finished

    return make(spec, meaning, size)


def synthesize_volume(
    spec: TextureSpec,
    size: tuple[int, int, int],
    meaning: Meaning = "colour",
    report: Report = silent,
) -> Volume:
    """Make the volume of a solid texture and of all textures nested in it.

    Equal nested textures are made once.

    Args:
        spec: A texture of a solid technique, with none but solid ones in it.
        size: Width, height and depth in voxels, also of every nested volume.
        meaning: Of the slot that the texture itself is in.
        report: Told the finished part, 0..1, and the technique or its step.
    """
    uses = Counter(_keys(spec, meaning))
    shared: dict[Key, Volume] = {}
    done = 0

    def make(spec: TextureSpec, meaning: Meaning) -> Volume:
        nonlocal done
        key = _key(spec, meaning)
        if key in shared:
            return shared[key]
        inputs = {name: make(*slot) for name, slot in _slots(spec, meaning).items()}
        before = done

        def told(share: float, step: str) -> None:
            report((before + share) / len(uses), step)

        told(0.0, spec.technique)
        volume = _fill(spec, size, inputs, told)
        done += 1
        if uses[key] > 1:
            shared[key] = volume
        return volume

    return make(spec, meaning)


def closed_form(
    spec: TextureSpec, *, solid: bool, meaning: Meaning = "colour"
) -> ClosedForm | None:
    """Return a texture, with all nested in it, as a formula; None where there is none.

    Args:
        spec: A texture of any technique.
        solid: Whether it is asked for in space, else in the plane w = 0.
        meaning: Of the slot that the texture itself is in.
    """
    if isinstance(spec, PresetSpec):
        return closed_form(spec.composed(), solid=solid, meaning=meaning)
    module = _module(spec.technique)
    parameters = module.closed_form(spec, solid=solid) if hasattr(module, "closed_form") else None
    if parameters is None:
        return None
    inputs = {}
    for name, (nested, slot) in _slots(spec, meaning).items():
        found = closed_form(nested, solid=solid, meaning=slot)
        if found is None:
            return None
        inputs[name] = found
    return ClosedForm(spec.technique, parameters, inputs)


def techniques() -> list[str]:
    """Return the names of the techniques in this folder, in alphabetical order."""
    names = (module.name for module in pkgutil.iter_modules(__path__))
    return sorted(name for name in names if name in FAMILIES["textures"])


def warm(report: Report) -> None:
    """Compile every kernel that no process has; `report` gets share done and name."""
    names = techniques()
    for done, name in enumerate(names):
        report(done / len(names), name)
        compile_kernels(name)


def compile_kernels(technique: str) -> None:
    """Compile the kernels of one technique, unless the cache has them."""

    def compile_all() -> None:
        module = _module(technique)
        if hasattr(module, "warm"):
            module.warm()

    compiled_once(technique, compile_all)


def _fill(
    spec: TextureSpec, size: tuple[int, int, int], inputs: Mapping[str, Volume], report: Report
) -> Volume:
    """Make one volume; what is pointwise sees all slices below each other as one picture."""
    module = _module(spec.technique)
    if not spec.pointwise:
        return cast("Volume", module.synthesize_volume(spec, size, inputs, report))
    width, height, depth = size
    stacked = {name: volume.stacked() for name, volume in inputs.items()}
    made = module.synthesize(spec, (width, height * depth), stacked, report)
    return Volume.unstacked(made.image if isinstance(made, Outcome) else made, depth)


def _slots(spec: TextureSpec, meaning: Meaning) -> dict[str, tuple[TextureSpec, Meaning]]:
    """Return the textures directly within a spec, each with the meaning of its slot."""
    if isinstance(spec, PresetSpec):
        return {"composed": (spec.composed(), meaning)}
    slots = {}
    for name, field, value in fields_within(spec):
        if isinstance(value, TextureSpec) and not is_in_space(field):
            slots[name] = (value, meaning_of(field, meaning))
        elif isinstance(value, ParameterMap):
            slots[name] = (value.texture, DATA.meaning)
    return slots


def _key(spec: TextureSpec, meaning: Meaning) -> Key:
    return (spec.model_dump_json(), meaning)


def _keys(spec: TextureSpec, meaning: Meaning) -> Iterator[Key]:
    yield _key(spec, meaning)
    for slot in _slots(spec, meaning).values():
        yield from _keys(*slot)


def _sized_keys(spec: TextureSpec, meaning: Meaning, size: Size, load: Load) -> Iterator[SizedKey]:
    yield (*_key(spec, meaning), size)
    sizes = _sizes(spec, meaning, size, load)
    for name, slot in _slots(spec, meaning).items():
        yield from _sized_keys(*slot, sizes[name], load)


def _sizes(spec: TextureSpec, meaning: Meaning, size: Size, load: Load) -> dict[str, Size]:
    """Return the size at which each texture directly within a spec is made."""

    def measure(picture: ImageSpec) -> Size:
        found = load(picture, meaning)
        return found.width, found.height

    return {name: size_within(spec, name, size, measure) for name in _slots(spec, meaning)}


def _module(technique: str) -> ModuleType:
    return importlib.import_module(f"{__name__}.{technique}")
