import jsonschema_rs
import pytest

from api_schemas.language import FAMILIES
from api_schemas.requests import REQUESTS

ALL = [(family, name) for family, members in FAMILIES.items() for name in members]


def test_every_technique_is_listed_with_a_link_that_works(client):
    families = client.get("/v1/techniques").json()["families"]
    listed = [
        (family["family"], technique["name"])
        for family in families
        for technique in family["techniques"]
    ]

    assert listed == ALL
    for family in families:
        assert client.get(family["link"]).json() == family
        for technique in family["techniques"]:
            assert technique["summary"]
            assert client.get(technique["link"]).json()["name"] == technique["name"]


@pytest.mark.parametrize(("family", "name"), ALL)
def test_a_technique_tells_all_one_needs(client, family, name):
    page = client.get(f"/v1/techniques/{family}/{name}").json()
    spec = FAMILIES[family][name]

    assert page["description"]
    assert (page["revision"], page["source"]) == (spec.revision, spec.source)
    assert page["parameters"]["properties"]["technique"]["const"] == name
    jsonschema_rs.validator_for(page["parameters"])
    for text in references(page["parameters"]):
        assert text.removeprefix("#/$defs/") in page["parameters"]["$defs"]


def references(value):
    if isinstance(value, dict):
        if "$ref" in value:
            yield value["$ref"]
        for item in value.values():
            yield from references(item)
    elif isinstance(value, list):
        for item in value:
            yield from references(item)


def test_examples_are_requests_that_use_the_technique(client):
    page = client.get("/v1/techniques/textures/perlin").json()

    assert page["examples"]
    for body in page["examples"]:
        request = REQUESTS["texture" if "texture" in body else "render"].model_validate(body)
        assert '"technique":"perlin"' in request.model_dump_json()


@pytest.mark.parametrize("path", ["", "/textures", "/textures/perlin"])
def test_a_caller_that_has_the_page_gets_304(client, path):
    first = client.get(f"/v1/techniques{path}")
    headers = {"If-None-Match": first.headers["etag"]}
    second = client.get(f"/v1/techniques{path}", headers=headers)

    assert (second.status_code, second.content) == (304, b"")
    assert not first.headers["etag"].startswith("W/")


@pytest.mark.parametrize(
    "path", ["/x", "/textures/x", "/x/perlin", "/textures/", "/textures%2Fperlin/x"]
)
def test_unknown_techniques_are_404(client, path):
    assert client.get(f"/v1/techniques{path}").status_code == 404
