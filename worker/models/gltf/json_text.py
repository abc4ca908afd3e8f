"""From JSON text to values, with bounds on length and number before anything is built."""

from typing import Any

from pydantic_core import from_json

from worker.errors import UnusableAssetError
from worker.models.gltf.limits import JSON_BRACKETS_MAX, JSON_BYTES_MAX, JSON_COMMAS_MAX


def parse(text: memoryview) -> dict[str, Any]:
    """Read one JSON object; of equal keys the last counts.

    Raises:
        UnusableAssetError: `asset_unusable` for what is no JSON object in UTF-8 without a byte
            order mark, or is nested more than 200 levels deep; `asset_too_large` for too much text
            or too many values.
    """
    if len(text) > JSON_BYTES_MAX:
        raise UnusableAssetError(
            f"{len(text)} bytes of JSON; at most {JSON_BYTES_MAX} are taken, a GLB holds more",
            code="asset_too_large",
        )
    data = bytes(text)
    # There are no more objects, arrays and values than this, and a data URI has but one comma.
    brackets, commas = data.count(b"[") + data.count(b"{"), data.count(b",")
    if brackets > JSON_BRACKETS_MAX or commas > JSON_COMMAS_MAX:
        raise UnusableAssetError("the JSON has too many values", code="asset_too_large")
    try:
        value = from_json(data, allow_inf_nan=False, cache_strings="none")
    except ValueError as error:
        # The parser's words name kinds of tokens, a line and a column, never the text.
        raise UnusableAssetError(f"the JSON is malformed: {error}") from None
    if not isinstance(value, dict):
        raise UnusableAssetError("the JSON is not an object")
    return value
