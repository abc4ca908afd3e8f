"""From JSON text to values, with bounds on depth and number before anything is built."""

import re
from typing import Any, Final

from pydantic_core import from_json

from worker.errors import UnusableAssetError
from worker.geometry.gltf.limits import JSON_BRACKETS_MAX, JSON_COMMAS_MAX, JSON_DEPTH_MAX

_BRACKETS: Final = re.compile(rb'"[^"\\]*+(?:\\.[^"\\]*+)*+"?|[\[{]|[\]}]', re.DOTALL)


def parse(text: memoryview) -> dict[str, Any]:
    """Read one JSON object; of equal keys the last counts.

    Raises:
        UnusableAssetError: `asset_unusable` for what is no JSON object in UTF-8 without a byte
            order mark, or is nested too deep; `asset_too_large` for too many values.
    """
    data = bytes(text)
    # Text that is not in strings has at least so many of these; a data URI has one comma.
    if (
        data.count(b"[") + data.count(b"{") > JSON_BRACKETS_MAX
        or data.count(b",") > JSON_COMMAS_MAX
    ):
        raise UnusableAssetError("the JSON has too many values", code="asset_too_large")
    if _depth(data) > JSON_DEPTH_MAX:
        raise UnusableAssetError(f"the JSON is nested more than {JSON_DEPTH_MAX} levels deep")
    try:
        value = from_json(data, allow_inf_nan=False, cache_strings="none")
    except ValueError as error:
        # The parser's own words name only kinds of tokens, a line and a column.
        raise UnusableAssetError(f"the JSON is malformed: {error}") from None
    if not isinstance(value, dict):
        raise UnusableAssetError("the JSON is not an object")
    return value


def _depth(data: bytes) -> int:
    depth = deepest = 0
    for match in _BRACKETS.finditer(data):
        character = data[match.start()]
        if character in b"[{":
            depth += 1
            deepest = max(deepest, depth)
        elif character in b"]}":
            depth -= 1
    return deepest
