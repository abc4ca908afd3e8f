"""The example requests, which are also what documentation shows and tests run."""

import json
from functools import cache
from importlib.resources import files
from typing import Any

from api_schemas.requests import Kind

FOLDERS: dict[Kind, str] = {"texture": "textures", "render": "renders"}


def examples(kind: Kind) -> dict[str, dict[str, Any]]:
    """Return the example bodies of a kind by name."""
    return _bodies(FOLDERS[kind])


def batch_examples() -> dict[str, dict[str, Any]]:
    """Return the example bodies of batches by name."""
    return _bodies("batches")


@cache
def _bodies(name: str) -> dict[str, dict[str, Any]]:
    folder = files("api_schemas") / "examples" / name
    found = [entry for entry in folder.iterdir() if entry.name.endswith(".json")]
    return {
        entry.name.removesuffix(".json"): json.loads(entry.read_text("utf-8"))
        for entry in sorted(found, key=lambda entry: entry.name)
    }
