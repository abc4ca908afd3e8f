"""The OpenAPI document: what FastAPI gathers, made complete and canonical.

The copy in the repository is written by `python -m service.openapi` and compared by a test.
"""

import json
from typing import Any

from fastapi import FastAPI
from fastapi.openapi.utils import get_openapi
from pydantic.json_schema import models_json_schema

from api_schemas.batches import ListedBatch, SweptBatch
from api_schemas.problems import Problem
from api_schemas.requests import REQUESTS

DESCRIPTION = """\
Describe a texture or a scene in JSON, get back a picture you can trust.

Colours are linear Rec.709, angles radians, worlds right-handed with y up. Every refusal is an
RFC 9457 problem with a stable `code` and JSON pointers to what is wrong.
"""


def document(app: FastAPI) -> dict[str, Any]:
    """Return the OpenAPI document of an app."""
    found = get_openapi(
        title=app.title,
        version=app.version,
        description=DESCRIPTION,
        routes=app.routes,
        separate_input_output_schemas=False,
    )
    models = [*REQUESTS.values(), ListedBatch, SweptBatch, Problem]
    _, extra = models_json_schema(
        [(model, "validation") for model in models], ref_template="#/components/schemas/{model}"
    )
    schemas = found.setdefault("components", {}).setdefault("schemas", {})
    schemas |= extra["$defs"]
    for name in ("HTTPValidationError", "ValidationError"):
        schemas.pop(name, None)
    for operations in found["paths"].values():
        for operation in operations.values():
            _drop_default_refusal(operation["responses"])
    return found


def canonical(app: FastAPI) -> str:
    """Return the document as text that only changes when the interface does."""
    return json.dumps(document(app), indent=2, sort_keys=True, ensure_ascii=False) + "\n"


def _drop_default_refusal(responses: dict[str, Any]) -> None:
    """Remove the 422 that FastAPI adds to whatever has a parameter."""
    content = responses.get("422", {}).get("content", {})
    schema = content.get("application/json", {}).get("schema", {})
    if schema.get("$ref", "").endswith("/HTTPValidationError"):
        del responses["422"]
