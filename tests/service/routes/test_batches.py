"""Batches: listed and swept, all or nothing, with one manifest."""

import time
from concurrent.futures import ThreadPoolExecutor

import pytest

from api_schemas.batches import AXES_MAX, ITEMS_MAX
from service.examples import batch_examples, examples
from service.tenants import tenant

UNKNOWN = "0" * 32
SCENE = examples("render")["shapes"]


def texture(seed=0, width=16, height=16, **more):
    return {
        "texture": {"technique": "perlin", "seed": seed},
        "output": {"size": [width, height]},
        **more,
    }


def post(client, body, **headers):
    return client.post("/v1/batches", json=body, headers=headers)


def made(client, body):
    response = post(client, body)
    assert response.status_code == 202, response.text
    return response.json()


def finished(client, batch):
    """Wait for the end of a batch."""
    deadline = time.monotonic() + 60
    while (now := client.get(batch["links"]["self"]).json())["finished"] is None:
        assert time.monotonic() < deadline
        time.sleep(0.02)
    return now


def manifest(client, batch):
    return client.get(batch["links"]["manifest"]).json()


def swept(mode, *axes, request=None):
    return {
        "request": request or texture(),
        "sweep": {
            "mode": mode,
            "axes": [{"pointer": pointer, "values": values} for pointer, values in axes],
        },
    }


def newest(client):
    """The ids of the newest job and of the newest batch."""
    return [
        [item["id"] for item in client.get(f"/v1/{name}?limit=1").json()[name]]
        for name in ("jobs", "batches")
    ]


def refusal(client, body, status=409):
    """The code and the pointer of a refusal, after which nothing was recorded."""
    before = newest(client)
    response = post(client, body)
    assert response.status_code == status, response.text
    assert newest(client) == before
    problem = response.json()
    return problem["code"], problem.get("pointer", problem.get("problems", [{}])[0].get("pointer"))


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


def test_a_grid_is_every_value_with_every_other_the_last_changing_fastest(client):
    axes = [("/texture/seed", [1, 2, 3]), ("/output/size", [[8, 8], [9, 9]])]
    told = manifest(client, made(client, swept("grid", *axes)))["items"]

    assert [item["values"] for item in told] == [
        {"/texture/seed": seed, "/output/size": size} for seed in axes[0][1] for size in axes[1][1]
    ]
    assert len({item["digest"] for item in told}) == 6
    alone = client.post("/v1/validate", json=texture(2, 9, 9)).json()["digest"]
    assert told[3]["digest"] == alone


def test_a_zip_takes_the_first_of_each_then_the_second(client):
    body = swept("zip", ("/texture/seed", [1, 2, 3]), ("/texture/octaves", [4, 5, 6]))
    told = manifest(client, made(client, body))["items"]

    assert [item["values"] for item in told] == [
        {"/texture/seed": n, "/texture/octaves": n + 3} for n in (1, 2, 3)
    ]


def test_a_sweep_goes_into_defaults_and_into_lists(client):
    """Neither the octaves nor the output are written in the request; the size has two numbers."""
    request = {"texture": {"technique": "perlin"}}
    axes = [("/texture/octaves", [2]), ("/output/size/1", [64]), ("/output/size/0", [32])]
    [item] = manifest(client, made(client, swept("zip", *axes, request=request)))["items"]
    alone = {"texture": {"technique": "perlin", "octaves": 2}, "output": {"size": [32, 64]}}

    assert item["digest"] == client.post("/v1/validate", json=alone).json()["digest"]


def test_a_sweep_over_whole_textures_leaves_their_defaults_open(client):
    values = [{"technique": "checkerboard"}, {"technique": "perlin", "seed": 5}]
    told = manifest(client, made(client, swept("grid", ("/texture", values))))["items"]
    expected = [
        client.post("/v1/validate", json={**texture(), "texture": value}).json()["digest"]
        for value in values
    ]

    assert [item["digest"] for item in told] == expected


@pytest.mark.parametrize(
    "pointer",
    [
        *("/texture/sede", "/scene", "/texture/seed/0", "/texture/~0", "/"),
        *(f"/output/size/{index}" for index in ("2", "01", "-", "-1", "9" * 400)),
    ],
)
def test_a_pointer_to_nothing_is_named(client, pointer):
    body = swept("grid", ("/texture/seed", [1]), (pointer, [1]))

    assert refusal(client, body) == ("sweep_pointer_unknown", "/sweep/axes/1/pointer")


@pytest.mark.parametrize("pointer", ["", "texture/seed", "/texture/~2", "/texture/~"])
def test_what_is_no_pointer_does_not_fit_the_schema(client, pointer):
    found = refusal(client, swept("grid", (pointer, [1])), 422)

    assert found == ("request_invalid", "/sweep/axes/0/pointer")


@pytest.mark.parametrize("other", ["/texture/seed", "/texture"])
def test_axes_into_each_other_are_refused(client, other):
    body = swept("grid", ("/texture/seed", [1]), (other, [1]))

    assert refusal(client, body) == ("sweep_pointers_overlap", "/sweep/axes/1/pointer")


def test_a_zip_of_unequal_lists_is_refused(client):
    body = swept("zip", ("/texture/seed", [1, 2]), ("/texture/octaves", [1, 2, 3]))

    assert refusal(client, body) == ("sweep_lengths_differ", "/sweep/axes/1/values")


def test_a_value_that_does_not_fit_is_named(client):
    axes = [("/texture/octaves", [1, 2]), ("/texture/seed", [1, "x", 2])]

    assert refusal(client, swept("grid", *axes)) == (
        "sweep_value_invalid",
        "/sweep/axes/1/values/1",
    )


def test_a_mistake_within_a_value_is_named(client):
    values = [{"technique": "perlin"}, {"technique": "perlin", "seed": -1}]

    assert refusal(client, swept("grid", ("/texture", values))) == (
        "sweep_value_invalid",
        "/sweep/axes/0/values/1/seed",
    )


def test_what_a_value_breaks_elsewhere_is_named_there(client):
    """A checkerboard has no seed: written in the request, it is what is too much."""
    body = swept("grid", ("/texture/technique", ["perlin", "checkerboard"]))

    assert refusal(client, body) == ("sweep_value_invalid", "/request/texture/seed")


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


def test_a_grid_beyond_the_limit_is_refused_before_it_is_made(client):
    """8 axes of 1000 values would be 10^24 requests."""
    names = ["seed", "octaves", "frequency", "lacunarity", "gain"]
    there = set(client.post("/v1/validate", json=texture()).json()["normalised"]["texture"])
    axes = [(f"/texture/{name}", list(range(1000))) for name in names if name in there]
    axes += [("/output/size/0", list(range(1000))), ("/output/size/1", list(range(1000)))]
    code, pointer = refusal(client, swept("grid", *axes[:AXES_MAX]))

    assert (code, pointer) == ("batch_too_large", "/sweep/axes")
    axes = [("/texture/seed", list(range(7))), ("/output/size/0", list(range(1, 144)))]
    assert refusal(client, swept("grid", *axes))[0] == "batch_too_large", "7 * 143 = 1001"


def test_a_batch_that_costs_too_much_altogether_is_refused(client):
    big = {"texture": {"technique": "perlin", "octaves": 16}, "output": {"size": [4096, 4096]}}
    one = client.post("/v1/validate", json=big).json()
    assert one["possible"]
    count = int(60 * one["limit"]["seconds"] / one["estimate"]["seconds"]) + 1
    assert count <= 1000
    body = swept("grid", ("/texture/seed", list(range(count))), request=big)
    problem = post(client, body).json()

    assert problem["code"] == "over_budget"
    assert problem["estimate"]["seconds"] > problem["limit"]["seconds"]
    assert problem["limit"]["seconds"] == 60 * one["limit"]["seconds"]


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
