"""Says where in a body a mistake lies and what would be right, without repeating what was sent.

pydantic's locations hold names of union members besides the keys of the input; which is which only
the model's schema can tell, since a member may be called like a key.
"""

from collections.abc import Iterator, Mapping, Sequence
from typing import Any, Final

from pydantic import ValidationError
from pydantic_core import ErrorDetails

from api_schemas.base import Schema
from api_schemas.problems import Obstruction

MOST_TOLD: Final = 50
LONGEST_KEY: Final = 100

OBJECT: Final = ("wrong_type", "must be an object")
MESSAGES: Final[Mapping[str, tuple[str, str]]] = {
    "missing": ("missing", "is missing"),
    "union_tag_not_found": ("missing", "is missing"),
    "extra_forbidden": ("unknown_key", "is not known here"),
    "union_tag_invalid": ("not_a_choice", "must be one of {expected_tags}"),
    "literal_error": ("not_a_choice", "must be {expected}"),
    "model_type": OBJECT,
    "model_attributes_type": OBJECT,
    "dict_type": OBJECT,
    "list_type": ("wrong_type", "must be a list"),
    "float_type": ("wrong_type", "must be a number"),
    "int_type": ("wrong_type", "must be a whole number"),
    "int_from_float": ("wrong_type", "must be a whole number"),
    "bool_type": ("wrong_type", "must be true or false"),
    "string_type": ("wrong_type", "must be a text"),
    "greater_than_equal": ("out_of_range", "must be at least {ge}"),
    "greater_than": ("out_of_range", "must be more than {gt}"),
    "less_than_equal": ("out_of_range", "must be at most {le}"),
    "less_than": ("out_of_range", "must be less than {lt}"),
    "too_short": ("wrong_length", "must have at least {min_length} items"),
    "too_long": ("wrong_length", "must have at most {max_length} items"),
    "repeated": ("repeated", "must not have an item twice"),
    "string_too_short": ("wrong_length", "must have at least {min_length} characters"),
    "string_too_long": ("wrong_length", "must have at most {max_length} characters"),
    "string_pattern_mismatch": ("wrong_text", "must match {pattern}"),
}
"""Code and message by pydantic's error type; the braces are filled from the schema's own bounds."""


def obstructions(error: ValidationError, model: type[Schema]) -> list[Obstruction]:
    """Return what is wrong with a parsed body that did not fit its model, in order."""
    details = error.errors(include_url=False, include_input=False)
    return [_obstruction(item, model) for item in details[:MOST_TOLD]]


def told(kind: str, context: Mapping[str, Any]) -> tuple[str, str]:
    """Return code and message of a mistake by pydantic's error type and context."""
    code, message = MESSAGES.get(kind, ("invalid", "does not fit the schema"))
    return code, message.format(**context)


def json_pointer(keys: Sequence[str | int]) -> str:
    """Join keys to a JSON pointer (RFC 6901)."""
    return "".join("/" + str(key).replace("~", "~0").replace("/", "~1") for key in keys)


def _obstruction(error: ErrorDetails, model: type[Schema]) -> Obstruction:
    keys = list(_keys(error["loc"], model))
    context = error.get("ctx", {})
    if error["type"] in ("union_tag_invalid", "union_tag_not_found"):
        keys.append(context["discriminator"].strip("'"))
    while keys and len(str(keys[-1])) > LONGEST_KEY:
        keys.pop()
    code, message = told(error["type"], context)
    return Obstruction(code=code, pointer=json_pointer(keys), message=message)


def _keys(location: Sequence[str | int], model: type[Schema]) -> Iterator[str | int]:
    """Yield those items of a location that are keys or indices of the input."""
    definitions: dict[str, Any] = {}
    schema: Any = model.__pydantic_core_schema__
    for item in location:
        schema = _unwrapped(schema, definitions)
        match schema:
            case {"type": "tagged-union" | "union", "choices": choices}:
                schema = _member(choices, item)
            case {"type": "model-fields", "fields": fields}:
                yield item
                schema = fields.get(item, {}).get("schema")
            case {"type": "list", "items_schema": items}:
                yield item
                schema = items
            case _:
                yield item
                schema = None


def _member(choices: Any, label: str | int) -> Any:
    """Return the member of a union that a location names; nothing if it cannot be told."""
    return choices.get(label) if isinstance(choices, Mapping) else None


def _unwrapped(schema: Any, definitions: dict[str, Any]) -> Any:
    """Strip what has no part in locations: names, defaults, functions round a schema."""
    while isinstance(schema, Mapping):
        if schema["type"] == "definitions":
            definitions |= {entry["ref"]: entry for entry in schema["definitions"]}
            schema = schema["schema"]
        elif schema["type"] == "definition-ref":
            schema = definitions[schema["schema_ref"]]
        elif "schema" in schema:
            schema = schema["schema"]
        else:
            break
    return schema
