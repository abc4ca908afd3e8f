"""What stands between a request that fits its schema and its picture, told over HTTP."""

import json
import os

import pytest

from tests.model_facts import model_facts


@pytest.fixture
def upload(client):
    """Uploads a file of which these facts are told, and returns its name."""

    def upload(facts):
        content = b"toy " + json.dumps({**facts, "sha256": os.urandom(9).hex()}).encode()
        return client.post("/v1/assets", content=content).json()["sha256"]

    return upload


def render(client, mesh, **output):
    body = {"scene": {"nodes": [{"mesh": {"type": "model", **mesh}}]}, "output": output}
    return client.post("/v1/renders", json=body)


def test_a_model_is_rendered_with_nothing_else_said(client, upload):
    answer = render(client, {"asset": upload(model_facts())}, size=[1, 1])

    assert answer.status_code == 202


def test_every_file_that_was_not_uploaded_is_told(client, upload):
    files = {"a.bin": "1" * 64, "b.png": "2" * 64}
    answer = render(client, {"asset": upload(model_facts(files=list(files))), "files": files})

    assert answer.status_code == 409
    assert [(item["code"], item["pointer"]) for item in answer.json()["problems"]] == [
        ("asset_missing", f"/scene/nodes/0/mesh/files/{name}") for name in files
    ]


def test_a_model_without_its_files_is_told_their_names(client, upload):
    answer = render(client, {"asset": upload(model_facts(files=["a.bin"]))})

    assert (answer.status_code, answer.json()["code"]) == (409, "asset_file_missing")
    assert answer.json()["pointer"] == "/scene/nodes/0/mesh/files"
    assert "a.bin" in answer.json()["detail"]


def test_an_asset_of_another_kind_is_told(client, upload):
    buffer = {"kind": "buffer", "format": "bin", "media_type": "application/gltf-buffer"}
    answer = render(client, {"asset": upload(buffer)})

    assert (answer.status_code, answer.json()["code"]) == (409, "asset_kind_mismatch")
    assert answer.json()["pointer"] == "/scene/nodes/0/mesh/asset"


def test_a_thousand_problems_are_told_as_far_as_one_answer_goes(client, upload):
    mesh = {"asset": upload(model_facts()), "nodes": [{"node": "x"}] * 256}
    body = {"scene": {"nodes": [{"mesh": {"type": "model", **mesh}}] * 4}}
    answer = client.post("/v1/renders", json=body | {"output": {"size": [16384, 16384]}})
    validated = client.post("/v1/validate", json=body)

    assert (answer.status_code, answer.json()["code"]) == (409, "model_part_unknown")
    assert len(answer.json()["problems"]) == 100
    assert answer.json()["problems"][-1]["code"] == "over_budget"
    assert len(validated.json()["problems"]) == 99


def test_as_many_missing_pictures_are_a_problem_and_not_our_mistake(client):
    surface = {
        "technique": "unlit",
        "color": {"texture": {"technique": "image", "asset": "0" * 64}},
    }
    nodes = [{"mesh": {"type": "box"}, "surface": surface}] * 101
    answer = client.post("/v1/renders", json={"scene": {"nodes": nodes}})

    assert (answer.status_code, answer.json()["code"]) == (409, "asset_missing")


def test_a_huge_model_is_over_budget(client, upload):
    answer = render(client, {"asset": upload(model_facts(triangles=2**30, vertices=2**30))})

    assert (answer.status_code, answer.json()["code"]) == (409, "over_budget")


@pytest.mark.parametrize(
    "mesh",
    [
        {"files": {"": "0" * 64}},
        {"files": {"a": "x"}},
        {"files": {str(number): "0" * 64 for number in range(257)}},
        {"files": []},
        {"scene": -1},
        {"materials": [{"material": -1, "surface": {"technique": "phong"}}]},
        {"materials": [{"material": 1.5, "surface": {"technique": "phong"}}]},
        {"materials": [{"material": None, "surface": {"technique": "phong"}}]},
        {"materials": [{"material": True, "surface": {"technique": "phong"}}]},
        {"materials": [{"material": 0}]},
        {"nodes": [{"node": "x" * 257}]},
        {"asset": None},
        {"path": "/etc/passwd"},
    ],
)
def test_a_model_that_is_none_does_not_fit_the_schema(client, mesh):
    answer = render(client, {"asset": "0" * 64, **mesh})

    assert (answer.status_code, answer.json()["code"]) == (422, "request_invalid")
    assert all(
        item["pointer"].startswith("/scene/nodes/0/mesh/") for item in answer.json()["problems"]
    )
