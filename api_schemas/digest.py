"""One name for equal work: a request's canonical form and its SHA-256."""

import hashlib
import json
from typing import Any

from api_schemas.families import TechniqueSpec
from api_schemas.requests import Request
from api_schemas.walk import parts

ENGINE_REVISION = 4
"""Raised when shared code (encoding, filtering, shading) gives other pixels for equal requests."""


def digest(request: Request) -> str:
    """Return the SHA-256 of a normalised request, in hexadecimal.

    It covers every parameter with defaults filled in, the revision of every technique used and the
    engine's; it does not cover the priority, which changes no pixel. Key order and the sign of
    zero do not matter.
    """
    revisions = {
        type(part).__module__: part.revision
        for _, part in parts(request)
        if isinstance(part, TechniqueSpec)
    }
    canonical = {
        "body": _unsigned_zeros(request.model_dump(mode="json", exclude={"priority"})),
        "revisions": revisions,
        "engine": ENGINE_REVISION,
    }
    text = json.dumps(canonical, sort_keys=True, separators=(",", ":"), allow_nan=False)
    return hashlib.sha256(text.encode()).hexdigest()


def _unsigned_zeros(value: Any) -> Any:
    if isinstance(value, dict):
        return {key: _unsigned_zeros(item) for key, item in value.items()}
    if isinstance(value, list):
        return [_unsigned_zeros(item) for item in value]
    return 0.0 if value == 0 and isinstance(value, float) else value
