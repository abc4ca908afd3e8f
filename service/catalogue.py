"""All techniques, described by their own specs: documents made once, with strong ETags."""

import hashlib
import inspect
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Final

from api_schemas.base import Schema
from api_schemas.families import TechniqueSpec, TextureSpec
from api_schemas.language import FAMILIES
from api_schemas.requests import REQUESTS
from api_schemas.techniques import Families, Family, Technique, TechniqueSummary
from api_schemas.walk import parts
from service.examples import examples

ROOT: Final = "/v1/techniques"


@dataclass(frozen=True, slots=True)
class Document:
    """A JSON document and the SHA-256 of its bytes."""

    body: bytes
    sha256: str


def catalogue() -> Mapping[str, Document]:
    """Return every document by its path below the root: "", "family" and "family/name"."""
    families = [_family(name, members) for name, members in FAMILIES.items()]
    found = {"": _document(Families(families=families))}
    for family in families:
        found[family.family] = _document(family)
        for name, spec in FAMILIES[family.family].items():
            found[f"{family.family}/{name}"] = _document(_technique(family.family, name, spec))
    return found


def _family(family: str, members: Mapping[str, type[TechniqueSpec]]) -> Family:
    return Family(
        family=family,
        link=f"{ROOT}/{family}",
        techniques=[
            TechniqueSummary(
                name=name,
                summary=_description(spec).partition("\n")[0],
                link=f"{ROOT}/{family}/{name}",
            )
            for name, spec in members.items()
        ],
    )


def _technique(family: str, name: str, spec: type[TechniqueSpec]) -> Technique:
    return Technique(
        family=family,
        name=name,
        description=_description(spec),
        source=spec.source,
        equation=spec.equation,
        revision=spec.revision,
        sized=spec.sized if issubclass(spec, TextureSpec) else None,
        solid=spec.solid if issubclass(spec, TextureSpec) else None,
        parameters=_parameters(spec),
        examples=[
            body
            for kind, model in REQUESTS.items()
            for body in examples(kind).values()
            if any(isinstance(part, spec) for _, part in parts(model.model_validate(body)))
        ],
    )


def _parameters(spec: type[TechniqueSpec]) -> dict[str, Any]:
    """Return a schema whose top is the technique itself, also where it may hold itself."""
    schema = spec.model_json_schema()
    if "$ref" in schema:
        return {**schema["$defs"][spec.__name__], "$defs": schema["$defs"]}
    return schema


def _description(spec: type[TechniqueSpec]) -> str:
    return inspect.getdoc(spec) or ""


def _document(model: Schema) -> Document:
    body = model.model_dump_json().encode()
    return Document(body, hashlib.sha256(body).hexdigest())
