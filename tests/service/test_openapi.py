"""The published document: complete, canonical, and the one in the repository."""

import json
import tomllib
from pathlib import Path

import pytest

from api_schemas.version import VERSION
from service.app import create_app
from service.openapi import FILE
from service.openapi_document import canonical
from service.problems import TABLE
from service.settings import Settings

ROOT = Path(__file__).resolve().parents[2]
DOCUMENT = json.loads(canonical(create_app(Settings())))
OPERATIONS = {
    f"{method.upper()} {path}": operation
    for path, operations in DOCUMENT["paths"].items()
    for method, operation in operations.items()
}


def test_the_committed_document_is_that_of_the_code():
    assert FILE.read_text("utf-8") == canonical(create_app(Settings())), (
        "run `python -m service.openapi`, look at the difference and commit it"
    )


def test_the_served_document_is_the_committed_one(client):
    assert client.get("/openapi.json").json() == json.loads(FILE.read_text("utf-8"))


def test_the_version_is_the_projects():
    project = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))["project"]

    assert project["version"] == VERSION == DOCUMENT["info"]["version"]


def values(value, key):
    if isinstance(value, dict):
        if isinstance(value.get(key), str):
            yield value[key]
        for item in value.values():
            yield from values(item, key)
    elif isinstance(value, list):
        for item in value:
            yield from values(item, key)


def test_every_reference_leads_somewhere_and_every_schema_is_used():
    schemas = DOCUMENT["components"]["schemas"]
    used = {name.rpartition("/")[2] for name in values(DOCUMENT, "$ref")}

    assert used == set(schemas)


def test_operations_have_names_and_links_name_operations():
    names = [operation["operationId"] for operation in OPERATIONS.values()]
    linked = {
        link["operationId"]
        for operation in OPERATIONS.values()
        for response in operation["responses"].values()
        for link in response.get("links", {}).values()
    }

    assert len(names) == len(set(names))
    assert all(name.islower() for name in names)
    assert {
        *("get_job", "cancel_job", "get_preview", "get_result", "get_events"),
        *("get_batch", "cancel_batch", "get_manifest"),
        *("get_asset", "delete_asset"),
    } == linked


@pytest.mark.parametrize("name", OPERATIONS)
def test_every_operation_is_explained_and_its_refusals_are_problems(name):
    operation = OPERATIONS[name]
    assert operation["summary"]
    assert operation["description"]
    assert operation["tags"]

    for status, response in operation["responses"].items():
        assert response["description"]
        if int(status) >= 400:
            content = response["content"]
            assert list(content) == ["application/problem+json"]
            schema = content["application/problem+json"]["schema"]
            assert schema == {"$ref": "#/components/schemas/Problem"}
            codes = response["description"].split("`")[1::2]
            assert codes
            assert all(TABLE[code][0] == int(status) for code in codes)
        if status in ("429", "503", "507"):
            assert "Retry-After" in response["headers"]
        if status in ("201", "202", "303"):
            assert "Location" in response["headers"]
        if status == "304":
            assert "ETag" in response["headers"]


def test_every_code_is_documented_but_those_that_no_operation_is_asked_for():
    text = json.dumps(DOCUMENT)
    undocumented = {code for code in TABLE if f"`{code}`" not in text}

    assert undocumented == {
        "not_found",
        "method_not_allowed",
        "internal_error",
        "request_timeout",
    }


def test_events_are_described_as_what_they_are():
    content = OPERATIONS["GET /v1/jobs/{job_id}/events"]["responses"]["200"]["content"]

    assert list(content) == ["text/event-stream"]
    event = content["text/event-stream"]["schema"]["properties"]
    assert event["data"]["contentSchema"] == {"$ref": "#/components/schemas/Job"}


def test_bodies_are_the_published_models_and_hold_examples():
    for kind in ("Texture", "Render"):
        content = OPERATIONS[f"POST /v1/{kind.lower()}s"]["requestBody"]["content"]
        schema = content["application/json"]["schema"]

        assert schema == {"$ref": f"#/components/schemas/{kind}Request"}
        assert content["application/json"]["examples"]
        assert DOCUMENT["components"]["schemas"][f"{kind}Request"]["additionalProperties"] is False
