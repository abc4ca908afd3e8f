import re
from pathlib import Path

import pytest

from service.problems import TABLE, ProblemError

PERLIN = {"texture": {"technique": "perlin"}}
SECRET = "hunter2"
ROOT = Path(__file__).parents[2]


@pytest.mark.parametrize("code", TABLE)
def test_every_code_makes_a_problem(code):
    status, title = TABLE[code]
    response = ProblemError(code, "why").response()

    assert response.status_code == status
    assert response.media_type == "application/problem+json"
    assert f'"type":"urn:texloom:problem:{code}","title":"{title}"' in response.body.decode()


@pytest.mark.parametrize(
    "path", ["/nothing", "/v1", "/v1/textures/", "/v1/jobs/x/y", "/v1//jobs", "/%00"]
)
def test_a_path_that_is_not_there_is_a_problem(client, path):
    response = client.get(path)

    assert (response.status_code, response.json()["code"]) == (404, "not_found")
    assert response.headers["content-type"] == "application/problem+json"


@pytest.mark.parametrize(
    ("method", "path", "allowed"),
    [
        ("GET", "/v1/textures", "POST"),
        ("DELETE", "/v1/renders", "POST"),
        ("PUT", "/v1/validate", "POST"),
        ("POST", "/v1/jobs", "GET"),
        ("PATCH", "/v1/jobs/x", "GET, HEAD, DELETE"),
        ("POST", "/v1/jobs/x/result", "GET, HEAD"),
        ("GET", "/v1/assets", "POST"),
        ("PUT", "/v1/assets/x", "GET, HEAD, DELETE"),
        ("OPTIONS", "/v1/jobs/x", "GET, HEAD, DELETE"),
        ("TRACE", "/v1/jobs", "GET"),
        ("BREW", "/v1/jobs", "GET"),
        ("DELETE", "/livez", "GET"),
    ],
)
def test_a_method_that_is_not_there_is_a_problem_that_names_those_that_are(
    client, method, path, allowed
):
    response = client.request(method, path)

    assert (response.status_code, response.json()["code"]) == (405, "method_not_allowed")
    assert response.headers["allow"] == allowed


def test_a_mistake_of_ours_is_a_problem_without_a_trace(client, engine, monkeypatch):
    def broken(*_arguments, **_options):
        raise RuntimeError(SECRET)

    monkeypatch.setattr(engine, "submit", broken)
    response = client.post("/v1/textures", json=PERLIN)

    assert (response.status_code, response.json()["code"]) == (500, "internal_error")
    assert response.headers["content-type"] == "application/problem+json"
    assert SECRET not in response.text
    assert "Traceback" not in response.text


@pytest.mark.parametrize(
    "body",
    [
        {"texture": {"technique": SECRET}},
        {"texture": {"technique": "perlin", "seed": SECRET}},
        {"texture": {"technique": "perlin", "fade": SECRET}},
        {"texture": {"technique": "image", "asset": SECRET}},
        {"texture": SECRET},
        [SECRET],
        SECRET,
        {"texture": {"technique": "constant", "value": [SECRET] * 9}},
        {"texture": {"technique": "perlin"}, "priority": SECRET},
    ],
)
def test_values_are_never_repeated(client, body):
    response = client.post("/v1/textures", json=body)

    assert response.status_code == 422
    assert SECRET not in response.text


def test_neither_are_parameters_or_paths(client):
    for path in (f"/v1/jobs?state={SECRET}", f"/v1/jobs?limit={SECRET}", f"/v1/jobs/{SECRET}"):
        assert SECRET not in client.get(path).text
    for path in (f"/{SECRET}", f"/v1/assets/{SECRET}", f"/v1/techniques/{SECRET}/{SECRET}"):
        assert SECRET not in client.get(path).text


def test_a_request_over_budget_tells_the_estimate_and_the_limit(client):
    body = PERLIN | {"output": {"size": [16384, 16384]}}
    problem = client.post("/v1/textures", json=body).json()

    assert problem["code"] == "over_budget"
    assert problem["estimate"]["bytes"] > problem["limit"]["bytes"]


def test_a_full_queue_is_429_and_says_when_to_come_back(make_client):
    client = make_client(slots=1, queue_limit=1)
    answers = [
        client.post(
            "/v1/textures",
            json={"texture": {"technique": "perlin", "seed": 1002}, "output": {"size": [1, n]}},
        )
        for n in range(1, 5)
    ]
    refused = [answer for answer in answers if answer.status_code != 202]

    assert answers[0].status_code == 202
    assert refused
    for answer in refused:
        assert (answer.status_code, answer.json()["code"]) == (429, "queue_full")
        assert int(answer.headers["retry-after"]) >= 1


def test_every_reason_that_anything_gives_is_in_the_table():
    """A code that is not would be an error of ours where the request has one."""
    said = set()
    for folder in ("api_schemas", "worker"):
        for path in (ROOT / folder).rglob("*.py"):
            source = path.read_text()
            said |= set(re.findall(r'\b(?:Obstacle|Refusal)\(\s*"(\w+)"', source))
            said |= set(re.findall(r'\bcode\b(?:: \w+)? ?= ?"(\w+)"', source))
            said |= set(re.findall(r'"code": "(\w+)"', source))

    assert len(said) > 25
    assert said <= set(TABLE)
