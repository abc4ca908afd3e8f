"""Walks over a request: every part of it with its JSON pointer and the meaning of the slot it is in."""

from collections.abc import Callable, Iterator
from typing import TypeVar

from api_schemas.base import Schema
from api_schemas.families import Meaning
from api_schemas.maps import Slot

Model = TypeVar("Model", bound=Schema)


def parts(value: object, pointer: str = "") -> Iterator[tuple[str, Schema]]:
    """Yield a schema and all schemas within it, parents first, each with its JSON pointer."""
    if isinstance(value, Schema):
        yield pointer, value
        for name in type(value).model_fields:
            yield from parts(getattr(value, name), f"{pointer}/{name}")
    elif isinstance(value, list):
        for index, item in enumerate(value):
            yield from parts(item, f"{pointer}/{index}")


def depth(value: object) -> int:
    """Return how many schemas lie within each other at the deepest place."""
    if isinstance(value, Schema):
        return 1 + max((depth(getattr(value, name)) for name in type(value).model_fields), default=0)
    if isinstance(value, list):
        return max(map(depth, value), default=0)
    return 0


def rewrite(
    model: Model, change: Callable[[Schema, Meaning], Schema], meaning: Meaning = "colour"
) -> Model:
    """Return a copy in which `change` has been applied to every schema, children first.

    `change` is told the meaning of the nearest slot above: colour or data.
    """
    updates = {}
    for name, field in type(model).model_fields.items():
        slot = next((item for item in field.metadata if isinstance(item, Slot)), None)
        before = getattr(model, name)
        after = _rewrite_value(before, change, slot.meaning if slot else meaning)
        if after is not before:
            updates[name] = after
    copy = model.model_copy(update=updates) if updates else model
    changed = change(copy, meaning)
    if not isinstance(changed, type(model)):
        raise TypeError(f"{type(changed).__name__} cannot stand where {type(model).__name__} was")
    return changed


def _rewrite_value(
    value: object, change: Callable[[Schema, Meaning], Schema], meaning: Meaning
) -> object:
    if isinstance(value, Schema):
        return rewrite(value, change, meaning)
    if isinstance(value, list):
        after = [_rewrite_value(item, change, meaning) for item in value]
        return value if all(a is b for a, b in zip(after, value, strict=True)) else after
    return value
