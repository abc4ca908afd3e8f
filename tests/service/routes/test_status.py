"""What people and Prometheus are told."""

import pytest
from prometheus_client.parser import text_string_to_metric_families

from api_schemas.status import ServiceStatus

BODY = {"texture": {"technique": "perlin", "seed": 77}, "output": {"size": [8, 8]}}


def metrics(client):
    answer = client.get("/metrics")
    assert answer.headers["content-type"].startswith("text/plain; version=")
    return {
        (sample.name, *sorted(sample.labels.items())): sample.value
        for family in text_string_to_metric_families(answer.text)
        for sample in family.samples
    }


def test_status_tells_queue_workers_and_store(client):
    client.post("/v1/textures", json=BODY, headers={"Prefer": "wait=30"})
    status = ServiceStatus.model_validate_json(client.get("/v1/status").text)

    assert set(status.queues) == {"interactive", "batch"}
    assert [slot.name for slot in status.slots] == ["slot-0", "slot-1"]
    assert sum(slot.jobs_done for slot in status.slots) >= 1
    assert status.store.results >= 1
    assert status.store.free_bytes > 0
    assert status.fingerprint == "toy"


def test_metrics_are_in_the_format_of_prometheus_and_count_requests(client):
    before = metrics(client)
    route = (("method", "GET"), ("route", "/v1/jobs/{job_id}"), ("status", "404"))
    for name in ("0" * 32, "x", "{evil}%0A"):
        client.get(f"/v1/jobs/{name}")
    after = metrics(client)

    key = ("texloom_http_requests_total", *route)
    assert after[key] - before.get(key, 0) == 3
    assert after["texloom_slots", ("state", "all")] == 2
    assert after["texloom_queue_depth", ("priority", "batch")] == 0


@pytest.mark.parametrize("path", ["/no/such/thing", "/v1/jobs/a/b/c/d", "/%0a"])
def test_what_callers_make_up_is_no_label(client, path):
    client.get(path)
    known = {dict(key[1:]).get("route") for key in metrics(client)}

    assert "none" in known
    assert path not in known


def test_a_cache_hit_is_counted(client):
    body = BODY | {"output": {"size": [9, 9]}}
    key = ("texloom_jobs_submitted_total", ("found", "finished"), ("priority", "interactive"))
    client.post("/v1/textures", json=body, headers={"Prefer": "wait=30"})
    before = metrics(client).get(key, 0)
    client.post("/v1/textures", json=body)

    assert metrics(client)[key] == before + 1
