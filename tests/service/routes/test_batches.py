"""Batches: all or nothing, with one manifest."""

import time
from concurrent.futures import ThreadPoolExecutor

import pytest

from api_schemas.batches import ITEMS_MAX
from service.examples import batch_examples
from service.tenants import tenant
from tests.service.batch_calls import SCENE, finished, made, manifest, post, refusal, swept, texture

UNKNOWN = "0" * 32


def test_a_list_becomes_jobs_in_its_order(client):
    body = {"items": [texture(n, 15) for n in range(5)] + [SCENE]}
    response = post(client, body)
    batch = response.json()
    told = manifest(client, finished(client, batch))

    assert response.headers["location"] == batch["links"]["self"]
    assert batch["size"] == 6
    assert [item["index"] for item in told["items"]] == list(range(6))
    assert [item["kind"] for item in told["items"]] == ["texture"] * 5 + ["render"]
    for item, asked in zip(told["items"], body["items"], strict=True):
        alone = client.post("/v1/validate", json=asked).json()
        assert item["digest"] == alone["digest"]
        assert item["values"] is None


def test_the_manifest_leads_to_every_file(client):
    batch = finished(client, made(client, {"items": [texture(n, 14) for n in range(3)]}))
    told = manifest(client, batch)

    assert told["batch"] == batch
    for item in told["items"]:
        job = client.get(item["links"]["job"]).json()
        file = client.get(item["links"]["result"])
        assert (job["id"], job["digest"]) == (item["job"], item["digest"])
        assert item["result"] == job["result"]
        assert file.headers["etag"] == f'"{item["result"]["sha256"]}"'


def test_counts_and_progress_add_up(client):
    batch = made(client, {"items": [texture(1, 13), texture(1001, 13), texture(1002, 13)]})
    deadline = time.monotonic() + 30
    while True:
        now = client.get(batch["links"]["self"]).json()
        if now["counts"]["succeeded"] == now["counts"]["failed"] == now["counts"]["running"] == 1:
            break
        assert time.monotonic() < deadline, now
        time.sleep(0.02)
    cancelled = client.delete(batch["links"]["cancel"])

    assert 2 / 3 <= now["progress"] < 1
    assert now["finished"] is None
    assert cancelled.status_code == 303
    assert cancelled.headers["location"] == batch["links"]["self"]
    end = cancelled.json()
    assert end["counts"] == {
        "queued": 0, "running": 0, "succeeded": 1, "failed": 1, "cancelled": 1,
    }  # fmt: skip
    assert end["progress"] == 1
    assert end["finished"] is not None
    states = {item["values"] is None and item["state"] for item in manifest(client, batch)["items"]}
    assert states == {"succeeded", "failed", "cancelled"}
    failed = manifest(client, batch)["items"][1]
    assert failed["failure"]["code"] == "render_failed"
    assert failed["result"] is failed["links"]["result"] is None


def test_an_item_that_cannot_be_done_is_named_and_nothing_is_queued(client):
    missing = {"texture": {"technique": "image", "asset": "0" * 64}, "output": {"size": [8, 8]}}
    body = {"items": [texture(1), missing, texture(2)]}
    swept_body = swept("grid", ("/texture/asset", ["1" * 64]), request=missing)

    assert refusal(client, body) == ("asset_missing", "/items/1/texture/asset")
    assert refusal(client, swept_body) == ("asset_missing", "/sweep/axes/0/values/0")


def test_an_item_that_does_not_fit_is_named(client):
    body = {"items": [texture(1), {"texture": {"technique": "perlin", "seed": -1}}]}

    assert refusal(client, body, 422) == ("request_invalid", "/items/1/texture/seed")


def test_every_item_that_cannot_be_done_is_told_up_to_a_bound(client):
    missing = {"texture": {"technique": "image", "asset": "0" * 64}}
    problem = post(client, {"items": [missing] * 200}).json()

    assert len(problem["problems"]) == 50
    assert problem["problems"][49]["pointer"] == "/items/49/texture/asset"


@pytest.mark.parametrize("body", [{}, [], 5, "x", {"items": []}, {"items": [texture()], "x": 1}])
def test_what_is_no_batch_is_refused(client, body):
    assert post(client, body).json()["code"] == "request_invalid"


def test_a_thousand_items_are_taken_and_one_more_is_refused(client):
    batch = made(client, {"items": [texture(n, 1, 1) for n in range(ITEMS_MAX)]})
    client.delete(batch["links"]["cancel"])

    assert batch["size"] == ITEMS_MAX == 1000
    too_many = {"items": [texture()] * (ITEMS_MAX + 1)}
    assert refusal(client, too_many, 422) == ("request_invalid", "/items")


def test_equal_items_are_done_once(client):
    batch = made(client, {"items": [texture(1004, 12)] * 50})
    end = finished(client, batch)
    told = manifest(client, batch)["items"]

    assert end["counts"]["succeeded"] == 50
    assert len({item["job"] for item in told}) == 50
    jobs = [client.get(item["links"]["job"]).json() for item in told[:5]]
    assert len({job["started"] for job in jobs}) == 1


def test_items_are_batch_work_unless_they_say_otherwise(client):
    body = {"items": [texture(1, 11), texture(2, 11, priority="interactive")]}
    told = manifest(client, made(client, body))["items"]
    priorities = [client.get(item["links"]["job"]).json()["priority"] for item in told]

    assert priorities == ["batch", "interactive"]


def test_a_full_batch_lets_single_requests_in(make_client):
    client = make_client(queue_limit=2, slots=1)
    batch = made(client, {"items": [texture(1002, 10, n + 1) for n in range(500)]})
    single = client.post("/v1/textures", json=texture(1, 10))
    client.delete(batch["links"]["cancel"])

    assert single.status_code == 202


def test_batches_wait_in_a_bounded_room(make_client):
    client = make_client(slots=1)
    batches = [
        made(client, {"items": [texture(1002, n + 1, m + 1) for n in range(1000)]})
        for m in range(4)
    ]
    response = post(client, {"items": [texture(1002, n + 1, 9) for n in range(1000)]})
    for batch in batches:
        client.delete(batch["links"]["cancel"])

    assert (response.status_code, response.json()["code"]) == (429, "queue_full")
    assert int(response.headers["retry-after"]) >= 1


def test_cancelling_leaves_to_others_what_they_want(client):
    shared, own = texture(1004, 9, 1), texture(1002, 9, 2)
    batch = made(client, {"items": [own, shared]})
    other = client.post("/v1/textures", json=shared).json()
    first, second = (client.delete(batch["links"]["cancel"]) for _ in range(2))
    done = client.get(other["links"]["self"], headers={"Prefer": "wait=20"}).json()

    assert first.json() == second.json()
    assert first.json()["counts"]["cancelled"] == 2
    assert done["state"] == "succeeded"


def test_cancelling_while_it_finishes_leaves_every_job_ended(client):
    """Each ends one way and stays so, and a file is there for each that succeeded."""
    batch = made(client, {"items": [texture(n, 8, 100) for n in range(200)]})
    time.sleep(0.1)
    with ThreadPoolExecutor(4) as pool:
        answers = list(pool.map(lambda _: client.delete(batch["links"]["cancel"]), range(4)))
    told = manifest(client, batch)

    assert {answer.status_code for answer in answers} == {303}
    counts = told["batch"]["counts"]
    assert counts["succeeded"] + counts["cancelled"] == 200
    assert told["batch"]["finished"] is not None
    for item in told["items"]:
        if item["state"] == "succeeded":
            assert client.head(item["links"]["result"]).status_code == 200
    time.sleep(0.3)
    assert manifest(client, batch)["batch"]["counts"] == counts


def test_a_manifest_that_has_not_changed_is_not_sent_again(client):
    batch = finished(client, made(client, {"items": [texture(1, 7)]}))
    first = client.get(batch["links"]["manifest"])
    again = client.get(batch["links"]["manifest"], headers={"If-None-Match": first.headers["etag"]})

    assert (again.status_code, again.content) == (304, b"")


def test_pages_show_every_batch_once_newest_first(client):
    names = [made(client, {"items": [texture(1, 6)]})["id"] for _ in range(5)]
    seen, link = [], "/v1/batches?limit=2"
    while link:
        page = client.get(link).json()
        assert len(page["batches"]) <= 2
        seen += [batch["id"] for batch in page["batches"]]
        link = page["next"]

    assert seen[:5] == names[::-1]
    assert len(seen) == len(set(seen))


@pytest.mark.parametrize("query", ["limit=0", "limit=101", "cursor=x", "cursor="])
def test_a_bad_parameter_is_422(client, query):
    assert client.get(f"/v1/batches?{query}").json()["code"] == "request_invalid"


@pytest.mark.parametrize("name", [UNKNOWN, "x", "0" * 31, "%00", "é", "0" * 999])
def test_unknown_batches_are_404(client, name):
    for method, path in (("GET", ""), ("DELETE", ""), ("GET", "/manifest")):
        response = client.request(method, f"/v1/batches/{name}{path}")
        assert (response.status_code, response.json()["code"]) == (404, "batch_unknown")


def test_nobody_sees_another_tenants_batches(app, client):
    batch = made(client, {"items": [texture(1, 5)]})
    app.dependency_overrides[tenant] = lambda: "somebody else"
    try:
        for method, link in (("GET", "self"), ("DELETE", "cancel"), ("GET", "manifest")):
            assert client.request(method, batch["links"][link]).status_code == 404
        assert client.get("/v1/batches").json() == {"batches": [], "next": None}
    finally:
        del app.dependency_overrides[tenant]


@pytest.mark.parametrize("name", batch_examples())
def test_the_examples_run(client, name):
    batch = finished(client, made(client, batch_examples()[name]))

    assert batch["counts"]["succeeded"] == batch["size"] > 1


def test_the_same_key_is_the_same_batch(client):
    body = {"items": [texture(n, 4) for n in range(3)]}
    with ThreadPoolExecutor(8) as pool:
        answers = list(
            pool.map(lambda _: post(client, body, **{"Idempotency-Key": "batch"}), range(8))
        )
    other = post(client, {"items": [texture(1, 3)]}, **{"Idempotency-Key": "batch"})

    assert {answer.status_code for answer in answers} == {202}
    assert len({answer.json()["id"] for answer in answers}) == 1
    assert other.json()["code"] == "idempotency_key_reused"
