"""Hypothesis strategies read off the published JSON Schema: any body the contract allows."""

import json
import re
from typing import Any

from hypothesis import strategies as st
from pydantic import TypeAdapter

from api_schemas.members import Texture
from api_schemas.requests import RenderRequest, TextureRequest
from api_schemas.surface_spec import Surface

ASSET = "0" * 64


def bodies(root: Any, *, levels: int = 2, number_limit: float = 1e6) -> st.SearchStrategy[Any]:
    """Draw JSON bodies valid for a model or union; numbers stay within +-number_limit.

    Textures nest up to `levels` deep; asset names are always ASSET.
    """
    schema = TypeAdapter(root).json_schema()
    return _Drawer(schema.get("$defs", {}), number_limit).value(schema, levels)


def textures(**options: Any) -> st.SearchStrategy[Any]:
    return bodies(Texture, **options)


def surfaces(**options: Any) -> st.SearchStrategy[Any]:
    return bodies(Surface, **options)


def texture_requests(**options: Any) -> st.SearchStrategy[Any]:
    return bodies(TextureRequest, **options)


def render_requests(**options: Any) -> st.SearchStrategy[Any]:
    return bodies(RenderRequest, **options)


class _Drawer:
    def __init__(self, definitions: dict[str, Any], number_limit: float) -> None:
        self.definitions = definitions
        self.number_limit = number_limit
        self.drawn: dict[tuple[str, int], st.SearchStrategy[Any]] = {}

    def value(self, schema: dict[str, Any], levels: int) -> st.SearchStrategy[Any]:
        if "$ref" in schema:
            name = schema["$ref"].rsplit("/", 1)[1]
            inside = levels - (name in {"Texture", "Node"})
            if (name, inside) not in self.drawn:
                self.drawn[name, inside] = st.deferred(
                    lambda: self.value(self.definitions[name], inside)
                )
            return self.drawn[name, inside]
        if "const" in schema:
            return st.just(schema["const"])
        if "enum" in schema:
            return st.sampled_from(schema["enum"])
        for union in ("oneOf", "anyOf"):
            if union in schema:
                return st.one_of(
                    *(self.value(s, levels) for s in self._shallow(schema[union], levels))
                )
        return getattr(self, schema["type"])(schema, levels)

    def _shallow(self, branches: list[dict[str, Any]], levels: int) -> list[dict[str, Any]]:
        """Drop branches that nest a texture once the levels are used up."""
        if levels > 0:
            return branches
        return [branch for branch in branches if not self._nests(branch)]

    def _nests(self, schema: dict[str, Any]) -> bool:
        if "$ref" in schema:
            schema = self.definitions[schema["$ref"].rsplit("/", 1)[1]]
        return '"#/$defs/Texture"' in json.dumps(schema)

    def object(self, schema: dict[str, Any], levels: int) -> st.SearchStrategy[Any]:
        if "properties" not in schema:
            names = st.text(st.characters(codec="utf-8"), min_size=1, max_size=8)
            return st.dictionaries(
                names, self.value(schema["additionalProperties"], levels), max_size=2
            )
        fields = {name: self.value(s, levels) for name, s in schema["properties"].items()}
        required = set(schema.get("required", ()))
        return st.fixed_dictionaries(
            {name: s for name, s in fields.items() if name in required},
            optional={name: s for name, s in fields.items() if name not in required},
        )

    def array(self, schema: dict[str, Any], levels: int) -> st.SearchStrategy[Any]:
        least = schema.get("minItems", 0)
        nested = levels <= 0 and schema["items"] == {"$ref": "#/$defs/Node"}
        most = least if nested else min(schema.get("maxItems", 2), max(least, 2))
        return st.lists(
            self.value(schema["items"], levels),
            min_size=least,
            max_size=most,
            unique=schema.get("uniqueItems", False),
        )

    def number(self, schema: dict[str, Any], _levels: int) -> st.SearchStrategy[Any]:
        return st.floats(
            max(schema.get("minimum", -self.number_limit), -self.number_limit),
            min(schema.get("maximum", self.number_limit), self.number_limit),
            allow_nan=False,
        )

    def integer(self, schema: dict[str, Any], _levels: int) -> st.SearchStrategy[Any]:
        return st.integers(schema["minimum"], schema["maximum"])

    def boolean(self, _schema: dict[str, Any], _levels: int) -> st.SearchStrategy[Any]:
        return st.booleans()

    def string(self, schema: dict[str, Any], _levels: int) -> st.SearchStrategy[Any]:
        if "pattern" in schema:
            known = re.fullmatch(schema["pattern"], ASSET)
            return st.just(ASSET) if known else st.from_regex(schema["pattern"], fullmatch=True)
        return st.text(st.characters(codec="utf-8"), max_size=schema["maxLength"])

    def null(self, _schema: dict[str, Any], _levels: int) -> st.SearchStrategy[Any]:
        return st.none()
