"""The requests of api_schemas/examples and the pictures they speak of."""

import hashlib
import json
from pathlib import Path
from typing import Any

import api_schemas
from api_schemas.requests import Kind

EXAMPLES = Path(api_schemas.__file__).parent / "examples"
ASSETS = sorted((EXAMPLES / "assets").iterdir())
KINDS: dict[str, Kind] = {"textures": "texture", "renders": "render"}


def examples() -> dict[str, tuple[Kind, dict[str, Any]]]:
    """Every example by name: its kind and its body."""
    return {
        path.stem: (KINDS[path.parent.name], json.loads(path.read_text()))
        for folder in KINDS
        for path in sorted((EXAMPLES / folder).glob("*.json"))
    }


def sha256(path: Path) -> str:
    return hashlib.sha256(path.read_bytes()).hexdigest()
