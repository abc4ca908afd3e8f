from starlette.testclient import TestClient

from service.app import create_app
from service.settings import Settings
from worker.jobs.engine import EmbeddedEngine

PERLIN = {"texture": {"technique": "perlin"}}


def test_it_is_alive_and_ready(client):
    assert client.get("/livez").json() == {"status": "alive"}
    ready = client.get("/readyz")

    assert ready.status_code == 200
    assert ready.json()["warm_slots"] >= 1
    assert ready.json()["fingerprint"] == "toy"


def test_it_is_not_ready_before_a_worker_is_warm_nor_while_it_stops(forkserver, tmp_path):
    engine = EmbeddedEngine(
        tmp_path / "data", slots=1, executor="slow_to_warm_executor", measurer="toy_measurer"
    )
    client = TestClient(create_app(Settings(), engine))
    engine.start()
    cold = client.get("/readyz")
    accepted = client.post("/v1/textures", json=PERLIN)
    engine.drain(0)
    stopping = client.get("/readyz")
    refused = client.post("/v1/textures", json=PERLIN)

    assert (cold.status_code, cold.json()["code"]) == (503, "not_ready")
    assert accepted.status_code == 202
    assert (stopping.status_code, stopping.json()["code"]) == (503, "draining")
    assert (refused.status_code, refused.json()["code"]) == (503, "draining")
    assert all(int(answer.headers["retry-after"]) >= 1 for answer in (cold, stopping, refused))
    assert client.get("/livez").status_code == 200
