"""A service that is told to stop finishes what it does and lets nobody hang."""

import signal
import threading
import time

import pytest

pytestmark = [pytest.mark.end_to_end, pytest.mark.gl]


def texture(seed, side=4500):
    return {
        "texture": {"technique": "perlin", "octaves": 12, "seed": seed},
        "output": {"size": [side, side]},
    }


def wait_until(is_so, seconds=60):
    deadline = time.monotonic() + seconds
    while not is_so():
        assert time.monotonic() < deadline
        time.sleep(0.02)


def test_a_stopping_service_finishes_its_job_and_refuses_more(make_service):
    service = make_service(slots="1")
    answers = []

    def ask(seed):
        with service.client() as client:
            headers = {"Accept": "image/png"}
            answers.append((seed, client.post("/v1/textures", json=texture(seed), headers=headers)))

    with service.client() as client:
        threads = [threading.Thread(target=ask, args=[seed]) for seed in (1, 2)]
        for thread, state in zip(threads, ("running", "queued"), strict=True):
            thread.start()
            wait_until(lambda state=state: client.get("/readyz").json()[state])
        service.process.send_signal(signal.SIGTERM)
        wait_until(lambda: client.get("/readyz").status_code == 503)
        refused = client.post("/v1/textures", json=texture(3))
        alive = client.get("/livez")
    for thread in threads:
        thread.join()

    assert (refused.status_code, refused.json()["code"]) == (503, "draining")
    assert int(refused.headers["retry-after"]) >= 1
    assert alive.status_code == 200
    by_seed = dict(answers)
    assert by_seed[1].status_code == 200
    assert by_seed[1].content.startswith(b"\x89PNG")
    assert (by_seed[2].status_code, by_seed[2].json()["state"]) == (202, "queued")
    assert service.process.wait(30) == 0
    assert "Traceback" not in service.log()


def test_what_was_queued_is_done_after_the_next_start(make_service):
    service = make_service(slots="1", drain_seconds="0")
    with service.client() as client:
        jobs = [client.post("/v1/textures", json=texture(seed)).json()["id"] for seed in (1, 2)]
    assert service.stop() == 0

    with service.start().client() as client:
        for job in jobs:
            done = client.get(f"/v1/jobs/{job}", headers={"Prefer": "wait=60"}).json()
            assert done["state"] == "succeeded"


def test_answers_on_a_kept_connection_do_not_wait_for_acknowledgements(service):
    with service.client() as client:
        seconds = []
        for _ in range(20):
            started = time.perf_counter()
            client.get("/livez")
            seconds.append(time.perf_counter() - started)

    # Nagle's algorithm against delayed acknowledgements costs 40 ms, every time.
    assert sorted(seconds)[5] < 0.03


def test_an_address_in_use_is_told_in_one_line(service, tmp_path):
    second = type(service)(tmp_path / "other", {"TEXLOOM_PORT": service.url.rpartition(":")[2]})
    second.data.parent.mkdir(exist_ok=True)
    with pytest.raises(AssertionError, match="cannot listen on"):
        second.start()
