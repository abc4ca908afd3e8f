"""Walks over a request: its parts with their JSON pointers and the meaning of their slots."""

from collections.abc import Callable, Iterator
from typing import TypeVar

from pydantic.fields import FieldInfo

from api_schemas.base import Schema
from api_schemas.families import Meaning
from api_schemas.maps import Slot

BRANCHES = (Schema, list)

Model = TypeVar("Model", bound=Schema)


def parts(value: object, pointer: str = "") -> Iterator[tuple[str, Schema]]:
    """Yield a schema and all schemas within it, parents first, each with its JSON pointer."""
    if isinstance(value, Schema):
        yield pointer, value
        for name in type(value).model_fields:
            inner = getattr(value, name)
            if isinstance(inner, BRANCHES):  # most are leaves, and a batch has many
                yield from parts(inner, f"{pointer}/{name}")
    elif isinstance(value, list):
        for index, item in enumerate(value):
            if isinstance(item, BRANCHES):
                yield from parts(item, f"{pointer}/{index}")


def fields_within(spec: Schema) -> Iterator[tuple[str, FieldInfo, object]]:
    """Yield name, field and value of each field of a spec, and of the parts in its lists.

    Those are named `<field>/<index>/<field of the part>`.
    """
    for name, field in type(spec).model_fields.items():
        value = getattr(spec, name)
        if isinstance(value, list) and value and isinstance(value[0], Schema):
            for index, part in enumerate(value):
                for inner, its_field in type(part).model_fields.items():
                    yield f"{name}/{index}/{inner}", its_field, getattr(part, inner)
        else:
            yield name, field, value


def part_with(spec: Schema, name: str) -> tuple[Schema, str]:
    """Return what holds a field that `fields_within` names, and the field's own name."""
    if "/" not in name:
        return spec, name
    of_list, index, inner = name.split("/")
    return getattr(spec, of_list)[int(index)], inner


def outermost(value: object, kind: type[Model]) -> Iterator[Model]:
    """Yield the schemas of a kind within a value that lie in no other one of it."""
    if isinstance(value, kind):
        yield value
    elif isinstance(value, Schema):
        for name in type(value).model_fields:
            yield from outermost(getattr(value, name), kind)
    elif isinstance(value, list):
        for item in value:
            yield from outermost(item, kind)


def escaped(key: str) -> str:
    """Write a key as a part of a JSON pointer (RFC 6901)."""
    return key.replace("~", "~0").replace("/", "~1")


def deepest(value: object, kinds: tuple[type[Schema], ...], pointer: str = "") -> tuple[int, str]:
    """Return how many schemas of the kinds lie within each other at most, and where."""
    if isinstance(value, Schema):
        inner = [
            deepest(getattr(value, name), kinds, f"{pointer}/{name}")
            for name in type(value).model_fields
        ]
        levels, place = max(inner, default=(0, pointer))
        place = place if levels else pointer
        return (levels + isinstance(value, kinds), place)
    if isinstance(value, list):
        return max(
            (deepest(item, kinds, f"{pointer}/{i}") for i, item in enumerate(value)),
            default=(0, pointer),
        )
    return (0, pointer)


def meaning_of(field: FieldInfo, above: Meaning) -> Meaning:
    """Return how a texture in a field is read: as its slot says, else as what holds it."""
    slot = _slot(field)
    return slot.meaning if slot else above


def is_in_space(field: FieldInfo) -> bool:
    """Whether a texture in a field is made as a volume by the technique that has the field."""
    slot = _slot(field)
    return slot is not None and slot.in_space


def rewrite(
    model: Model, change: Callable[[Schema, Meaning], Schema], meaning: Meaning = "colour"
) -> Model:
    """Return a copy in which `change` has been applied to every schema, children first.

    `change` is told the meaning of the nearest slot above: colour or data.
    """
    updates = {}
    for name, field in type(model).model_fields.items():
        before = getattr(model, name)
        after = _rewrite_value(before, change, meaning_of(field, meaning))
        if after is not before:
            updates[name] = after
    copy = model.model_copy(update=updates) if updates else model
    changed = change(copy, meaning)
    if not isinstance(changed, type(model)):
        raise TypeError(f"{type(changed).__name__} cannot stand where {type(model).__name__} was")
    return changed


def _slot(field: FieldInfo) -> Slot | None:
    return next((item for item in field.metadata if isinstance(item, Slot)), None)


def _rewrite_value(
    value: object, change: Callable[[Schema, Meaning], Schema], meaning: Meaning
) -> object:
    if isinstance(value, Schema):
        return rewrite(value, change, meaning)
    if isinstance(value, list):
        after = [_rewrite_value(item, change, meaning) for item in value]
        return value if all(a is b for a, b in zip(after, value, strict=True)) else after
    return value
