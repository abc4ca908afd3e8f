"""What the service can do."""

from functools import cache
from typing import Annotated, Final

from fastapi import APIRouter, Path
from starlette.requests import Request
from starlette.responses import Response

from api_schemas.language import FAMILIES
from api_schemas.techniques import Families, Family, Technique
from service.catalogue import catalogue
from service.documentation import ETAG, Responses, problems
from service.problems import ProblemError
from service.stored_files import names

router = APIRouter(prefix="/v1/techniques", tags=["techniques"])
documents = cache(catalogue)

FamilyName = Annotated[
    str, Path(description="A family's name.", json_schema_extra={"enum": sorted(FAMILIES)})
]
TechniqueName = Annotated[str, Path(description="A technique's name.")]
KNOWN: Final[Responses] = {304: {"description": "The caller has it already.", "headers": ETAG}}
UNKNOWN: Final = problems("technique_unknown")


def _found(model: type) -> Responses:
    return {200: {"description": "The description.", "model": model, "headers": ETAG}, **KNOWN}


@router.get(
    "",
    operation_id="list_families",
    summary="List all techniques",
    responses=_found(Families),
)
def list_families(request: Request) -> Response:
    """All families with their members."""
    return _answer(request, "")


@router.get(
    "/{family}",
    operation_id="list_techniques",
    summary="List the techniques of a family",
    responses=_found(Family) | UNKNOWN,
)
def list_techniques(request: Request, family: FamilyName) -> Response:
    """One family with its members."""
    return _answer(request, family)


@router.get(
    "/{family}/{name}",
    operation_id="get_technique",
    summary="Describe a technique",
    responses=_found(Technique) | UNKNOWN,
)
def get_technique(request: Request, family: FamilyName, name: TechniqueName) -> Response:
    """Its parameters as JSON Schema, where it comes from, and requests that use it."""
    return _answer(request, f"{family}/{name}")


def _answer(request: Request, path: str) -> Response:
    document = documents().get(path)
    if document is None:
        raise ProblemError("technique_unknown")
    etag = f'"{document.sha256}"'
    headers = {"ETag": etag, "Cache-Control": "no-cache"}
    if names(request.headers.get("if-none-match"), etag):
        return Response(status_code=304, headers=headers)
    return Response(document.body, headers=headers, media_type="application/json")
