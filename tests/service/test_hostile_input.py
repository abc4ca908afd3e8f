"""Whatever is sent, the answer is not our mistake, and the next request is served."""

import json
from urllib.parse import quote

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.examples import examples

PATHS = ("/v1/textures", "/v1/renders", "/v1/validate", "/v1/assets")
METHODS = ("GET", "HEAD", "POST", "PUT", "PATCH", "DELETE", "OPTIONS")
BODIES = [json.dumps(body).encode() for _, body in examples().values()]
HEADER = st.text(st.characters(min_codepoint=32, max_codepoint=126), max_size=30)
SEGMENT = st.text(st.characters(exclude_characters="/?#", exclude_categories=["Cs"]), max_size=20)


@pytest.fixture(autouse=True)
def the_next_request_is_served(client):
    yield
    assert client.get("/readyz").status_code == 200


def is_an_answer(response):
    return response.status_code < 500 and (
        response.status_code < 400
        or response.request.method == "HEAD"
        or response.headers["content-type"] == "application/problem+json"
    )


@settings(max_examples=100)
@given(path=st.sampled_from(PATHS), body=st.binary(max_size=200))
def test_any_bytes(client, path, body):
    headers = {"Content-Type": "application/json"}

    assert is_an_answer(client.post(path, content=body, headers=headers))
    assert is_an_answer(client.post(path, content=body))


@settings(max_examples=150)
@given(data=st.data())
def test_examples_with_bytes_changed(client, data):
    body = bytearray(data.draw(st.sampled_from(BODIES)))
    for _ in range(data.draw(st.integers(1, 4))):
        place = data.draw(st.integers(0, len(body) - 1))
        body[place : place + data.draw(st.integers(0, 3))] = data.draw(st.binary(max_size=3))
    for path in PATHS[:3]:
        headers = {"Content-Type": "application/json"}
        assert is_an_answer(client.post(path, content=bytes(body), headers=headers))


@settings(max_examples=100)
@given(
    method=st.sampled_from(METHODS),
    root=st.sampled_from(["jobs", "assets", "techniques", "techniques/textures", ""]),
    rest=st.lists(SEGMENT, max_size=3),
    query=st.dictionaries(
        st.sampled_from(["limit", "cursor", "state", "x"]), st.text(max_size=9)
    ).filter(lambda query: all(value.isprintable() for value in query.values())),
)
def test_any_path_and_query(client, method, root, rest, query):

    path = "/v1/" + "/".join([root, *(quote(part, safe="") for part in rest)])

    assert is_an_answer(client.request(method, path, params=query))


@settings(max_examples=100)
@given(accept=HEADER, prefer=HEADER, tags=HEADER, part=HEADER, media_type=HEADER, encoding=HEADER)
def test_any_headers(client, accept, prefer, tags, part, media_type, encoding):
    headers = {
        "Accept": accept,
        "Prefer": prefer,
        "If-None-Match": tags,
        "If-Range": tags,
        "Range": part,
        "Content-Type": media_type,
        "Content-Encoding": encoding,
    }
    job = client.get("/v1/jobs?limit=1").json()["jobs"]
    for path in PATHS:
        assert is_an_answer(client.post(path, content=BODIES[0], headers=headers))
    if job:
        assert is_an_answer(client.get(job[0]["links"]["result"], headers=headers))
