"""A request that is sent twice with the same key is made once."""

import asyncio
import time
from concurrent.futures import ThreadPoolExecutor

import httpx
import pytest

from service.examples import examples
from service.tenants import tenant

COUNT = [0]


@pytest.fixture
def key():
    COUNT[0] += 1
    return f"key-{COUNT[0]}"


def body(seed=0, side=16, **more):
    return {
        "texture": {"technique": "perlin", "seed": seed},
        "output": {"size": [side, 77]},
        **more,
    }


def post(client, key, content, path="/v1/textures", **headers):
    return client.post(path, json=content, headers={"Idempotency-Key": key, **headers})


def test_the_same_request_again_is_the_same_job(client, key):
    first = post(client, key, body(1002))
    second = post(client, key, body(1002))
    client.delete(first.json()["links"]["cancel"])

    assert first.json()["id"] == second.json()["id"]
    assert (first.status_code, second.status_code) == (202, 202)
    assert second.headers["location"] == first.headers["location"]


def test_the_status_is_that_of_the_job_as_it_is_now(client, key):
    first = post(client, key, body(1004, 17))
    done = client.get(first.json()["links"]["self"], headers={"Prefer": "wait=20"}).json()
    second = post(client, key, body(1004, 17))

    assert (first.status_code, second.status_code) == (202, 200)
    assert second.json() == done


def test_a_replay_may_wait_and_may_fetch_the_picture(client, key):
    first = post(client, key, body(1004, 18))
    waited = post(client, key, body(1004, 18), Prefer="wait=20")
    picture = post(client, key, body(1004, 18), Accept="image/png")

    assert waited.json()["id"] == first.json()["id"]
    assert waited.json()["state"] == "succeeded"
    assert picture.headers["content-type"] == "image/png"
    assert picture.headers["content-location"] == first.json()["links"]["result"]


def test_a_replay_does_not_make_the_picture_in_another_format(client, key):
    post(client, key, body(0, 19), Prefer="wait=20")
    response = post(client, key, body(0, 19), Accept="image/x-exr")

    assert (response.status_code, response.json()["code"]) == (406, "not_acceptable")


def test_another_body_with_the_same_key_is_refused(client, key):
    first = post(client, key, body(1))
    second = post(client, key, body(2))

    assert first.status_code in (200, 202)
    assert (second.status_code, second.json()["code"]) == (409, "idempotency_key_reused")
    assert post(client, key, body(1)).json()["id"] == first.json()["id"]


def test_a_body_that_is_only_written_differently_is_the_same(client, key):
    headers = {"Idempotency-Key": key, "Content-Type": "application/json"}
    one = '{"texture": {"technique": "perlin", "seed": 3}, "output": {"size": [16, 16]}}'
    two = '{"output":{"size":[16.0,1.6e1]},"texture":{"seed":3,"technique":"perlin"}}'
    first, second = (
        client.post("/v1/textures", content=text, headers=headers) for text in (one, two)
    )

    assert first.json()["id"] == second.json()["id"]


def test_keys_of_different_routes_and_tenants_are_different(app, client, key):
    scene = examples("render")["shapes"]
    texture = post(client, key, body(4))
    render = post(client, key, scene, "/v1/renders")
    batch = post(client, key, {"items": [body(4)]}, "/v1/batches")
    app.dependency_overrides[tenant] = lambda: "somebody else"
    try:
        theirs = post(client, key, body(5))
    finally:
        del app.dependency_overrides[tenant]

    assert [item.status_code // 100 for item in (texture, render, batch, theirs)] == [2, 2, 2, 2]
    assert len({item.json()["id"] for item in (texture, render, batch, theirs)}) == 4


def test_a_request_that_was_refused_has_not_used_its_key(client, key):
    refused = post(client, key, {"texture": {"technique": "image", "asset": "0" * 64}})
    accepted = post(client, key, body(6))

    assert refused.json()["code"] == "asset_missing"
    assert accepted.status_code in (200, 202)


def test_a_cancelled_job_stays_what_its_key_stands_for(client, key):
    job = post(client, key, body(1002, 20)).json()
    client.delete(job["links"]["cancel"])
    again = post(client, key, body(1002, 20))

    assert (again.status_code, again.json()["id"]) == (200, job["id"])
    assert again.json()["state"] == "cancelled"


def test_a_key_is_forgotten_after_a_day(client, key, monkeypatch):
    now = time.time()
    first = post(client, key, body(7)).json()
    monkeypatch.setattr("worker.jobs.idempotency.time.time", lambda: now + 24 * 3600 - 60)
    within = post(client, key, body(7)).json()
    monkeypatch.setattr("worker.jobs.idempotency.time.time", lambda: now + 24 * 3600 + 60)
    after = post(client, key, body(8))

    assert within["id"] == first["id"]
    assert after.status_code in (200, 202)
    assert after.json()["id"] != first["id"]


def test_twenty_callers_at_once_make_one_job(app, engine, key):
    before = len(engine.list("local", limit=100)[0])

    async def call_all():
        transport = httpx.ASGITransport(app)
        async with httpx.AsyncClient(transport=transport, base_url="http://test") as caller:
            return await asyncio.gather(
                *(
                    caller.post(
                        "/v1/textures", json=body(1004, 21), headers={"Idempotency-Key": key}
                    )
                    for _ in range(20)
                )
            )

    answers = asyncio.run(call_all())

    assert len({answer.json()["id"] for answer in answers}) == 1
    assert {answer.status_code for answer in answers} <= {200, 202}
    assert len(engine.list("local", limit=100)[0]) == min(before + 1, 100)


def test_of_two_bodies_at_once_one_wins(client, key):
    with ThreadPoolExecutor(8) as pool:
        answers = list(pool.map(lambda n: post(client, key, body(n % 2, 22)), range(8)))
    accepted = {item.json()["id"] for item in answers if item.status_code < 300}
    refused = [item.json()["code"] for item in answers if item.status_code >= 300]

    assert len(accepted) == 1
    assert refused == ["idempotency_key_reused"] * 4


@pytest.mark.parametrize("name", ["", "a b", "é".encode("latin-1"), "x" * 256])
def test_a_key_that_is_none_is_refused(client, name):
    response = post(client, name, body(9))

    assert (response.status_code, response.json()["code"]) == (422, "request_invalid")


@pytest.mark.parametrize("name", ["x", "~!@#$%^&*()", '"8e03978e-40d5-43dd-bc93-6894a57f9324"'])
def test_any_visible_characters_make_a_key(client, name):
    assert post(client, name, body(10)).status_code in (200, 202)
    assert post(client, name[:255], body(10)).status_code in (200, 202)


def test_a_replay_is_answered_when_the_queue_is_full(make_client):
    client = make_client(queue_limit=1, slots=1)
    jobs = [post(client, "a", body(1002, 30)).json()]
    client.get(jobs[0]["links"]["self"], headers={"Prefer": "wait=1"})
    jobs.append(post(client, "b", body(1002, 31)).json())
    refused = post(client, "c", body(1002, 32))
    replayed = post(client, "b", body(1002, 31))
    for job in jobs:
        client.delete(job["links"]["cancel"])

    assert refused.status_code == 429
    assert replayed.json()["id"] == jobs[1]["id"]
