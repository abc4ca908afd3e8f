import re

import pytest

from service.tenants import tenant

UNKNOWN = "0" * 32


def submit(client, seed=0, wait=30, **output):
    body = {
        "texture": {"technique": "perlin", "seed": seed},
        "output": {"size": [16, 16], **output},
    }
    return client.post("/v1/textures", json=body, headers={"Prefer": f"wait={wait}"})


@pytest.fixture
def done(client):
    """A job that succeeded."""
    return submit(client).json()


@pytest.fixture
def stuck(client):
    """A job that takes a minute, cancelled in the end."""
    job = submit(client, seed=1002, wait=0).json()
    yield job
    client.delete(job["links"]["cancel"])


def test_a_finished_job_is_told_with_200_and_a_new_one_with_202(client):
    assert submit(client).status_code == 200
    response = submit(client, seed=1004, size=[17, 17], wait=0)

    assert response.status_code == 202
    assert response.headers["location"] == response.json()["links"]["self"]
    assert int(response.headers["retry-after"]) >= 1


def test_the_same_request_again_is_done_at_once(client, done):
    again = submit(client, wait=0)

    assert again.status_code == 200
    assert again.json()["digest"] == done["digest"]
    assert again.json()["id"] != done["id"]


def test_a_job_tells_what_it_made(client, done):
    assert done["state"] == "succeeded"
    assert done["progress"] == 1
    assert done["result"]["media_type"] == "image/png"
    assert done["result"]["timings"] == {"make": 0.5}
    assert done["result"]["counts"] == {"pixels": 256}
    assert done["started"] <= done["finished"]
    assert client.get(done["links"]["self"]).json() == done


def test_head_tells_of_a_job_what_get_would(client, done):
    head, get = (client.request(method, done["links"]["self"]) for method in ("HEAD", "GET"))

    assert (head.status_code, head.content) == (200, b"")
    assert head.headers.keys() == get.headers.keys()
    differing = {name for name in get.headers if head.headers[name] != get.headers[name]}
    assert differing == {"x-request-id"}


def test_a_job_without_news_is_not_sent_again(client, stuck):
    client.get(stuck["links"]["self"], headers={"Prefer": "wait=1"})  # until it runs
    first = client.get(stuck["links"]["self"])
    have = {"If-None-Match": first.headers["etag"]}
    again = client.get(stuck["links"]["self"], headers=have)
    client.delete(stuck["links"]["cancel"])
    news = client.get(stuck["links"]["self"], headers=have)

    assert first.headers["etag"].startswith('W/"')
    assert (again.status_code, again.content) == (304, b"")
    assert again.headers["etag"] == first.headers["etag"]
    assert again.headers["retry-after"] == first.headers["retry-after"]
    assert (news.status_code, news.json()["state"]) == (200, "cancelled")
    assert news.headers["etag"] != first.headers["etag"]


def test_the_result_is_the_file(client, done):
    response = client.get(done["links"]["result"])

    assert response.status_code == 200
    assert response.headers["content-type"] == "image/png"
    assert response.headers["etag"] == f'"{done["result"]["sha256"]}"'
    assert "immutable" in response.headers["cache-control"]
    assert int(response.headers["content-length"]) == len(response.content)
    assert len(response.content) == done["result"]["bytes"]


def test_head_tells_what_get_would(client, done):
    head, get = (client.request(method, done["links"]["result"]) for method in ("HEAD", "GET"))

    assert (head.status_code, head.content) == (200, b"")
    of_the_request = {"x-request-id"}
    assert {*head.headers.items()} ^ {*get.headers.items()} <= {
        (name, answer.headers[name]) for name in of_the_request for answer in (head, get)
    }


@pytest.mark.parametrize("form", ["{}", "W/{}", '"other", {}', "*"])
def test_a_caller_that_has_the_result_gets_304(client, done, form):
    etag = f'"{done["result"]["sha256"]}"'
    response = client.get(
        done["links"]["result"], headers={"If-None-Match": form.replace("{}", etag)}
    )

    assert (response.status_code, response.content) == (304, b"")
    assert response.headers["etag"] == etag


@pytest.mark.parametrize(
    ("wanted", "begin", "end"),
    [
        ("bytes=0-3", 0, 4),
        ("bytes=4-", 4, None),
        ("bytes=-5", -5, None),
        ("bytes=0-99999", 0, None),
        ("bytes=-99999", 0, None),
        ("bytes=2-2", 2, 3),
    ],
)
def test_a_range_is_that_part_of_the_file(client, done, wanted, begin, end):
    whole = client.get(done["links"]["result"]).content
    response = client.get(done["links"]["result"], headers={"Range": wanted})
    first, last, size = map(
        int, re.fullmatch(r"bytes (\d+)-(\d+)/(\d+)", response.headers["content-range"]).groups()
    )

    assert response.status_code == 206
    assert response.content == whole[begin:end] == whole[first : last + 1]
    assert size == len(whole)


@pytest.mark.parametrize("wanted", ["bytes=3-2", "bytes=-", "bytes=0-1,4-5", "pages=1-2", "x"])
def test_a_range_that_is_nonsense_is_ignored(client, done, wanted):
    assert client.get(done["links"]["result"], headers={"Range": wanted}).status_code == 200


@pytest.mark.parametrize("wanted", ["bytes=67-", "bytes=99999-", "bytes=-0"])
def test_a_range_beyond_the_end_is_refused_with_416(client, done, wanted):
    response = client.get(done["links"]["result"], headers={"Range": wanted})

    assert (response.status_code, response.json()["code"]) == (416, "range_not_satisfiable")
    assert response.headers["content-range"] == f"bytes */{done['result']['bytes']}"


def test_a_range_of_another_version_gets_the_whole_file(client, done):
    headers = {"Range": "bytes=0-3", "If-Range": '"other"'}

    assert client.get(done["links"]["result"], headers=headers).status_code == 200


def test_a_caller_that_does_not_take_the_format_gets_406(client, done):
    accept = {"Accept": "image/x-exr, application/json"}
    response = client.get(done["links"]["result"], headers=accept)

    assert (response.status_code, response.json()["code"]) == (406, "not_acceptable")


def test_a_result_not_there_yet_is_409_and_says_when_to_come_back(client, stuck):
    response = client.get(stuck["links"]["result"])

    assert (response.status_code, response.json()["code"]) == (409, "job_not_finished")
    assert int(response.headers["retry-after"]) >= 1
    assert response.json()["instance"] == stuck["links"]["self"]


def test_a_cancelled_job_leads_to_itself_and_has_no_result(client, stuck):
    first, second = (client.delete(stuck["links"]["cancel"]) for _ in range(2))

    assert first.status_code == second.status_code == 303
    assert first.headers["location"] == stuck["links"]["self"]
    assert first.json()["state"] == second.json()["state"] == "cancelled"
    assert client.get(stuck["links"]["self"]).json()["state"] == "cancelled"
    assert client.get(stuck["links"]["result"]).json()["code"] == "job_cancelled"


def test_cancelling_a_finished_job_changes_nothing(client, done):
    assert client.delete(done["links"]["cancel"]).json() == done


def test_a_failed_job_tells_why(client):
    job = submit(client, seed=1001).json()
    refused = client.get(job["links"]["result"]).json()

    assert job["state"] == "failed"
    assert job["failure"]["code"] == "render_failed"
    assert (refused["code"], refused["failure"]) == ("job_failed", job["failure"])


def test_a_removed_result_is_410(client, engine):
    job = submit(client, size=[18, 18]).json()
    engine.result_path(engine.get("local", job["id"])).unlink()
    response = client.get(job["links"]["result"])

    assert (response.status_code, response.json()["code"]) == (410, "result_evicted")


def test_queued_jobs_know_their_place(client):
    running = [submit(client, seed=1002, size=[20, n], wait=0).json() for n in (1, 2)]
    waiting = [submit(client, seed=1002, size=[20, n], wait=0).json() for n in (3, 4)]
    found = [client.get(job["links"]["self"]).json() for job in waiting]
    for job in (*running, *waiting):
        client.delete(job["links"]["cancel"])

    assert [job["state"] for job in found] == ["queued", "queued"]
    assert found[1]["position"] == found[0]["position"] + 1


def test_pages_show_every_job_once_newest_first(client):
    jobs = [submit(client, size=[30, n]).json()["id"] for n in range(1, 6)]
    seen, link = [], "/v1/jobs?limit=2&state=succeeded"
    while link:
        page = client.get(link).json()
        assert len(page["jobs"]) <= 2
        seen += [job["id"] for job in page["jobs"]]
        link = page["next"]

    assert seen[:5] == jobs[::-1]
    assert len(seen) == len(set(seen))


@pytest.mark.parametrize(
    "query", ["limit=0", "limit=101", "limit=x", "cursor=x", "cursor=", "state=done", "limit="]
)
def test_a_bad_parameter_is_422_without_repeating_it(client, query):
    response = client.get(f"/v1/jobs?{query}")

    assert (response.status_code, response.json()["code"]) == (422, "request_invalid")
    assert query.partition("=")[0] in response.json()["detail"]


@pytest.mark.parametrize(
    "job_id", [UNKNOWN, "x", "0" * 31, "%00", "%ff", "..%2f..", "é", "0" * 999]
)
def test_unknown_jobs_are_404(client, job_id):
    for method, path in (("GET", ""), ("DELETE", ""), ("GET", "/result"), ("HEAD", "/result")):
        assert client.request(method, f"/v1/jobs/{job_id}{path}").status_code == 404


def test_nobody_sees_another_tenants_jobs(app, client, stuck, done):
    app.dependency_overrides[tenant] = lambda: "somebody else"
    try:
        for job in (stuck, done):
            for method, link in (("GET", "self"), ("DELETE", "cancel"), ("GET", "result")):
                response = client.request(method, job["links"][link])
                assert (response.status_code, response.json()["code"]) == (404, "job_unknown")
        assert client.get("/v1/jobs").json() == {"jobs": [], "next": None}
    finally:
        del app.dependency_overrides[tenant]

    assert client.get(stuck["links"]["self"]).json()["state"] != "cancelled"


def test_get_waits_for_the_end_where_that_is_preferred(client):
    job = submit(client, seed=1004, size=[40, 40], wait=0).json()
    response = client.get(job["links"]["self"], headers={"Prefer": "wait=20"})

    assert response.json()["state"] == "succeeded"
    assert response.headers["preference-applied"] == "wait=20"


def test_history_tells_how_long_it_will_take(make_client):
    """A job took .3 s: the next in line waits about as long, and then takes its own time."""
    client = make_client(slots=1)
    first = submit(client, seed=1004, size=[1, 1]).json()
    second = submit(client, seed=1002, size=[1, 2], wait=0).json()
    third = submit(client, seed=1002, size=[1, 3], wait=0).json()
    answers = [client.get(job["links"]["self"]).json() for job in (first, second, third)]
    client.delete(second["links"]["cancel"])
    client.delete(third["links"]["cancel"])

    assert answers[0]["eta_seconds"] is None, "it is finished"
    assert second["eta_seconds"] is not None
    assert answers[2]["state"] == "queued"
    assert 0.3 <= answers[2]["eta_seconds"] <= 10


def test_a_preview_is_seen_while_there_is_one(client, engine):
    job = submit(client, size=[18, 19]).json()
    missing = client.get(job["links"]["preview"])
    assert (missing.status_code, missing.json()["code"]) == (404, "preview_missing")

    known = engine.get("local", job["id"])
    left = engine.result_path(known).with_name(f"{known.work_id}.preview.part")
    left.write_bytes(b"half a picture")
    seen = client.get(job["links"]["preview"])
    assert (seen.status_code, seen.content) == (200, b"half a picture")
    assert (seen.headers["content-type"], seen.headers["cache-control"]) == (
        "image/png",
        "no-store",
    )
    assert client.get(f"/v1/jobs/{'0' * 32}/preview").json()["code"] == "job_unknown"
