"""Nothing is lost and nothing stays behind when processes are killed."""

import os
import signal
import time
from pathlib import Path

import pytest

pytestmark = [pytest.mark.end_to_end, pytest.mark.gl]

SLOW = {
    "scene": {
        "camera": {"type": "perspective", "pose": {"eye": [0, 0, 3]}},
        "nodes": [
            {
                "mesh": {"type": "plane"},
                "surface": {
                    "technique": "unlit",
                    "color": {"texture": {"technique": "checkerboard"}},
                },
            }
        ],
    },
    "output": {"size": [1500, 1500], "supersampling": 6, "format": "png"},
}


def wait_for(client, job, states, seconds=120):
    deadline = time.monotonic() + seconds
    while time.monotonic() < deadline:
        found = client.get(f"/v1/jobs/{job}").json()
        if found["state"] in states:
            return found
        time.sleep(0.02)
    raise AssertionError(f"still {found['state']} after {seconds} s")


def gone(pids, seconds=5):
    deadline = time.monotonic() + seconds
    while time.monotonic() < deadline:
        if not any(Path(f"/proc/{pid}/exe").exists() for pid in pids):
            return True
        time.sleep(0.02)
    return False


def busiest(pids):
    def used(pid):
        fields = Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()
        return int(fields[11]) + int(fields[12])

    before = {pid: used(pid) for pid in pids}
    time.sleep(0.3)
    return max(pids, key=lambda pid: used(pid) - before[pid])


def test_a_killed_child_does_its_job_again(make_service):
    service = make_service(slots="1")
    with service.client() as client:
        job = client.post("/v1/renders", json=SLOW).json()["id"]
        wait_for(client, job, {"running"})
        os.kill(busiest(service.processes() - {service.process.pid}), signal.SIGKILL)

        done = wait_for(client, job, {"succeeded", "failed"})

    assert (done["state"], done["attempt"]) == ("succeeded", 2)


def test_a_killed_service_leaves_no_process_and_finishes_the_job_when_it_is_back(make_service):
    service = make_service()
    with service.client() as client:
        job = client.post("/v1/renders", json=SLOW).json()["id"]
        wait_for(client, job, {"running"})
    children = service.processes() - {service.process.pid}
    service.kill()

    assert children
    assert gone(children)

    with service.start().client() as client:
        done = wait_for(client, job, {"succeeded", "failed"})

    assert (done["state"], done["attempt"]) == ("succeeded", 2)


def test_a_cancelled_job_stops_and_the_next_one_is_served(make_service):
    service = make_service(slots="1")
    with service.client() as client:
        job = client.post("/v1/renders", json=SLOW).json()["id"]
        wait_for(client, job, {"running"})

        assert client.delete(f"/v1/jobs/{job}").json()["id"] == job
        assert wait_for(client, job, {"cancelled"}, seconds=5)["state"] == "cancelled"
        service.wait_until_warm()
        following = client.post(
            "/v1/textures",
            json={"texture": {"technique": "perlin"}, "output": {"size": [16, 16]}},
            headers={"Accept": "image/png"},
        )

    assert following.status_code == 200
    assert following.content.startswith(b"\x89PNG")


def test_a_full_queue_answers_429_and_says_when_to_come_back(make_service):
    service = make_service(slots="1", queue_limit="1")
    with service.client() as client:
        answers = []
        for seed in range(4):
            body = {**SLOW, "output": {**SLOW["output"], "size": [1500, 1500 - seed]}}
            answers.append(client.post("/v1/renders", json=body))
        refused = [answer for answer in answers if answer.status_code == 429]

    assert refused
    assert all(int(answer.headers["retry-after"]) >= 1 for answer in refused)
    assert all(a.headers["content-type"] == "application/problem+json" for a in refused)
    assert service.stop() == 0
