"""The JSON door: a body becomes a value, or one of the named problems, and never a surprise.

What gets through is exactly one JSON value of RFC 8259 that float64 can hold, with unique keys.
"""

import json
import math
import re
from collections.abc import Awaitable, Callable
from typing import Any, Final, TypeVar

from pydantic import ValidationError
from starlette.concurrency import run_in_threadpool
from starlette.requests import Request

from api_schemas.base import Schema
from service.limited_body import chunks
from service.pointers import obstructions
from service.problems import ProblemError

DEPTH_MAX: Final = 100
DIGITS_MAX: Final = 400
EXACT_MAX: Final = 2.0**53
BRACKETS: Final = re.compile(r'"[^"\\]*+(?:\\.[^"\\]*+)*+"?|[\[{]|[\]}]', re.DOTALL)
UTF8_NAMES: Final = ("utf-8", "utf8")

Model = TypeVar("Model", bound=Schema)


def body_of(model: type[Model]) -> Callable[[Request], Awaitable[Model]]:
    """Return a dependency that reads a request's body as the model."""

    async def read(request: Request) -> Model:
        return await run_in_threadpool(validated, model, await json_bytes(request))

    return read


async def json_bytes(request: Request, times: int = 1) -> bytes:
    """Return the body of a request that says it is JSON; `times` as long as others may be.

    Raises:
        ProblemError: It is not JSON by its own account, or too large.
    """
    require_json(request)
    limit = times * request.app.state.settings.body_limit_bytes
    return b"".join([chunk async for chunk in chunks(request, limit)])


def require_json(request: Request) -> None:
    """Refuse what is not application/json, in UTF-8, uncompressed."""
    media_type, _, parameters = request.headers.get("content-type", "").partition(";")
    name, _, charset = parameters.strip().partition("=")
    if media_type.strip().lower() != "application/json":
        raise ProblemError("media_type_unsupported", "the body must be application/json")
    if name and (
        name.strip().lower() != "charset" or charset.strip('" ').lower() not in UTF8_NAMES
    ):
        raise ProblemError("media_type_unsupported", "the only parameter taken is charset=utf-8")
    if request.headers.get("content-encoding", "identity").lower() != "identity":
        raise ProblemError("media_type_unsupported", "compressed bodies are not taken")


def validated(model: type[Model], body: bytes) -> Model:
    """Return the body as a model.

    Raises:
        ProblemError: It is not JSON (400), or does not fit the model (422).
    """
    return fitted(model, parsed(body))


def fitted(model: type[Model], value: Any) -> Model:
    """Return a parsed value as a model.

    Raises:
        ProblemError: It does not fit.
    """
    try:
        return model.model_validate(value)
    except ValidationError as error:
        found = obstructions(error, model)
        raise ProblemError(
            "request_invalid",
            f"{found[0].pointer or 'the body'}: {found[0].message}",
            problems=found,
        ) from None


def parsed(body: bytes) -> Any:
    """Return the one JSON value in the body; whole numbers are integers however they are written.

    Raises:
        ProblemError: There is no such value.
    """
    try:
        text = body.decode()
    except UnicodeDecodeError as error:
        raise ProblemError("json_encoding", f"byte {error.start} is not UTF-8") from None
    if text.startswith("\ufeff"):
        raise ProblemError("json_encoding", "the body begins with a byte order mark")
    _require_shallow(text)
    try:
        value = json.loads(
            text,
            parse_int=_integer,
            parse_float=_real,
            parse_constant=_constant,
            object_pairs_hook=_object,
        )
    except json.JSONDecodeError as error:
        where = f"line {error.lineno}, column {error.colno}"
        raise ProblemError("json_malformed", f"{error.msg} at {where}") from None
    if "\\u" in text:
        _require_whole_characters(value)
    return value


def _require_shallow(text: str) -> None:
    depth = 0
    for found in BRACKETS.finditer(text):
        bracket = found[0]
        if bracket in "[{":
            depth += 1
            if depth > DEPTH_MAX:
                raise ProblemError("json_too_deep", f"at most {DEPTH_MAX} levels are taken")
        elif bracket in "]}":
            depth -= 1


def _require_whole_characters(value: Any) -> None:
    """Refuse surrogates that do not come in pairs: no encoding can hold them."""
    waiting = [value]
    while waiting:
        item = waiting.pop()
        if isinstance(item, str):
            try:
                item.encode()
            except UnicodeEncodeError:
                raise ProblemError(
                    "json_surrogate", "an escape is half of a surrogate pair"
                ) from None
        elif isinstance(item, dict):
            waiting += [*item, *item.values()]
        elif isinstance(item, list):
            waiting += item


def _integer(digits: str) -> int:
    if len(digits) > DIGITS_MAX:
        raise ProblemError("json_number", f"an integer has more than {DIGITS_MAX} digits")
    value = int(digits)
    try:
        float(value)
    except OverflowError:
        raise ProblemError("json_number", "a number is beyond what float64 holds") from None
    return value


def _real(digits: str) -> float | int:
    value = float(digits)
    if not math.isfinite(value):
        raise ProblemError("json_number", "a number is beyond what float64 holds")
    return int(value) if value.is_integer() and abs(value) <= EXACT_MAX else value


def _constant(name: str) -> float:
    raise ProblemError("json_number", f"{name} is not JSON")


def _object(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    keys = dict(pairs)
    if len(keys) != len(pairs):
        raise ProblemError("json_duplicate_key", "an object holds the same key more than once")
    return keys
